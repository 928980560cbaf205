#pragma once
// What a fit found, and its verdict: intervals are widened, or withheld.

#include "postproc/fits/fit_findings.h"

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// The same model with a finer mesh, or finer steps, at the estimates.
struct FinerModel {
  std::string what;               ///< is finer: "mesh.z[0].cells = 10"
  std::vector<double> residuals;  ///< as many as those of the fit
};

/// What findings do not hold of what a verdict needs.
struct JudgedData {
  std::vector<ResidualSeries> series{};
  std::size_t n_elsewhere = 0;  ///< FitEvidence::n_elsewhere
  /// The fit, where correlated residuals may be noise: of a sound one they widen the intervals. Null: they leave none.
  const FitResult* result = nullptr;
  bool correlated_is_noise = true;  ///< false: correlated residuals are an error of the model, and leave no intervals
  double negligible = 0.0;          ///< FitEvidence::negligible
  double misfit = 0.0;              ///< FitEvidence::misfit
  std::vector<std::string> reasons{};  ///< that only this kind of fit knows
  std::optional<FinerModel> finer{};   ///< needs the fit
};
/// Gives findings their verdict. Estimates of a fit that is not sound lose their intervals and standard errors, those
/// of one with correlated residuals get wider ones, and one that has failed has not converged. What a finer
/// discretisation does to the residuals counts as explained, and intervals hold what it does to estimates: the standard
/// error is of the noise alone. Returns whether the residuals are more than white noise.
bool judge(FitFindings& found, JudgedData data);

/// Standard error and interval are larger by a factor, 1 or more; the interval by Student's t of so many degrees of
/// freedom.
void widen(FittedParameter& p, double by, double freedom);

/// Deviations, before they are widened, at the ends of the interval of 95 % of a parameter that is widened; nothing of
/// others.
std::optional<double> reach_of_widened(const FittedParameter& p);

/// One more reason: the findings are questionable at best, and lose their intervals.
void question(FitFindings& found, std::string reason);
/// All of them but those of a posterior that holds a discrepancy of the model.
void withhold_intervals(FitFindings& found);

/// Moves the end of an interval of noise alone that lies on the side of what a finer discretisation says, by as much,
/// not beyond the bounds of the parameter.
void hold_move(const FittedParameter& p, double& lower, double& upper);

}  // namespace pfdm
