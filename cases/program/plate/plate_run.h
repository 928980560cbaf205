#pragma once
// The computation of a plate case: modes, frequency response, heating.

#include "cases/program/plate/plate_results.h"
#include "cases/program/session/terminal/log.h"

#include <functional>

namespace pfdm {

/// Throws InputError for what does not fit the mesh.
ElasticBody elastic_body(const PlateCase& c, const Mesh& mesh);

/// The unknown nearest to a place: a cell's or, on the surface, a face's.
Index nearest_unknown(const VibratingBody& body, const Vector& place);

class PlateRun {
 public:
  /// With so many modes, which resonances() tells and heat() the first of. The case and the mesh must outlive the run.
  PlateRun(const PlateCase& c, const Mesh& mesh, int n_modes);
  /// From now on of this case, which differs from the first one in its modulus, loss, excitation, heat and cooling
  /// only: the same body, a factor on its stiffness. Must outlive the run. Throws ComputationError like
  /// BaseResponse::reach().
  void take(const PlateCase& c);

  const VibratingBody& body() const { return body_; }
  const std::vector<Mode>& modes() const { return modes_; }
  std::vector<Resonance> resonances(double temperature) const;
  ResponseTable response() const;
  /// H1 of a place at the temperature of the start.
  std::vector<std::complex<double>> transmissions(const Vector& place, std::span<const double> frequencies) const;
  /// Of the base's motion: the given one, or that of the largest power at the temperature [Hz]; only of a harmonic one.
  double driving_frequency(double temperature) const;
  Eigen::Index dimension() const { return response_.dimension(); }

  /// Heats the body; `done` is called at the start and after each step.
  using Done = std::function<void(const HeatingRow&, const HeatedBody&, const CellField<double>& source)>;
  void heat(double frequency, const Done& done) const;
  /// The surface at the ends of the steps of [heating], and their length; of a body whose modulus does not depend on
  /// the temperature, so that its heat stays as it is. As heat() tells it, within 1e-7 of the largest rise.
  std::vector<SurfaceTemperature> steady_surface(double frequency, double& step) const;
  /// u of the motion at the excitation's level, of a harmonic one [m].
  Eigen::VectorXcd motion(double frequency, double temperature) const;

 private:
  struct Part {
    double frequency;  // [Hz]
    double weight;     // mean squared amplitude of the base's acceleration that it stands for [m^2/s^4]
  };
  struct Heat {
    CellField<double> source;  // [W/m^3]
    double power = 0.0;        // mechanical [W]
    double correction = 0.0;   // of the strain energy's heat, relative
  };
  /// c of the stiffness that the body has.
  Harmonic at(double frequency, double temperature) const;
  std::vector<Harmonic> all_harmonics() const;
  double first_resonance(double temperature) const;  // [Hz]; 0 of a run without modes
  std::vector<Part> parts(double frequency) const;
  Heat heat_of(const std::vector<Part>& parts, double temperature) const;

  const PlateCase* case_;
  double modulus_;  // of the body's stiffness [Pa]
  const Mesh& mesh_;
  VibratingBody body_;
  std::vector<Mode> modes_;
  BaseResponse response_;
};

}  // namespace pfdm
