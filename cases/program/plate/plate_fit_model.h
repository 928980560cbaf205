#pragma once
// A plate as a model of what is measured on it: H1 and the rise of its surface's temperature from values of its case.

#include "cases/program/plate/plate_fit_case.h"
#include "cases/program/plate/plate_run.h"
#include "cases/program/session/terminal/log.h"
#include "postproc/fits/fit_judgement.h"

#include <span>
#include <string>

namespace pfdm {

/// What the plate does where it was measured.
struct PlateCurves {
  std::vector<std::vector<std::complex<double>>> H1;  ///< of each response
  std::vector<std::vector<double>> rise;              ///< of each measured rise [K]
};

/// What a measured H1 is taken for; as it is wanted by default: acceleration over the base's, of motions exp(+i omega
/// t).
struct ResponseReading {
  bool conjugate = false;  ///< of motions exp(-i omega t)
  bool relative = false;   ///< acceleration relative to the base
};

/// One mesh, whose stiffness is solved with once.
class PlateModel {
 public:
  /// All must outlive the model.
  PlateModel(const CaseFile& file, const PlateFit& fit, const PlateCase& c, const Mesh& mesh);

  /// The case with these values of the parameters [SI].
  PlateCase with(std::span<const double> values) const;
  /// Nothing where the case has no resonance within its response, or makes no sense.
  std::optional<PlateCurves> curves(const PlateCase& c);
  /// Of model less measurement over their standard deviation: magnitudes (of their logarithms) and phases of each
  /// response, then the rises.
  std::optional<std::vector<double>> residuals(const PlateCase& c);
  /// residuals() of values of the parameters, each computed once: a fit asks for them again beside every Jacobian, and
  /// for the last Jacobian again where it ends. As long as the reading stays.
  Residuals remembered_residuals();
  /// From now on residuals() takes the measured H1 for this and, but for the usual reading, leaves the rises out.
  void read_as(const ResponseReading& reading) { reading_ = reading; }
  /// In that order.
  std::vector<ResidualSeries> series(const std::vector<double>& residuals) const;

 private:
  std::vector<std::vector<double>> rises();
  bool reads_as_usual() const { return !reading_.conjugate && !reading_.relative; }

  const CaseFile& file_;
  const PlateFit& fit_;
  std::vector<CaseParameter> parameters_;
  PlateCase case_;
  PlateRun run_;
  ResponseReading reading_;
};

/// What a model that is wrong may lack: the rms of the residuals would fall to this with it.
struct FitSuspect {
  std::string what;
  double rms = 0.0;
};

/// What the model may lack, and what of the residuals would be left with it and the parameters estimated anew, to first
/// order; the one that leaves least first.
std::vector<FitSuspect> suspects_of(PlateModel& model, const PlateFit& fit, const std::vector<double>& values,
                                    const std::vector<double>& residuals);

/// Other readings of the measured H1, each with the rms that a fit of H1 alone leaves, from the first guess on; the one
/// that leaves least first.
std::vector<FitSuspect> suspected_readings(PlateModel& model, const PlateFit& fit, FitSettings settings);

/// The residuals at these values on the mesh that [fit] `finer` makes, or, of a plate of box_hexes, on one of five
/// thirds of its layers; nothing where neither is known, or the layers are ten already.
std::optional<FinerModel> on_finer_mesh(const CaseFile& file, const PlateFit& fit, const std::vector<double>& values,
                                        Log& log);

}  // namespace pfdm
