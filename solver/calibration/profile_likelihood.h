#pragma once
// Confidence intervals by profile likelihood: of parameter k all values at which the others, estimated anew, leave a
// sum of squares S with
//
//   (S - S_min) / s^2 <= t^2,
//
// s^2 the variance of the noise and t Student's 97.5 % quantile (of the normal distribution where the noise is known).
// Unlike the linear interval it follows the curvature of the model, and ends at a bound where the data allow everything
// up to it (Bates, Watts, Nonlinear Regression Analysis and Its Applications, Wiley 1988, section 6.1; Venzon,
// Moolgavkar, Appl. Statist. 37 (1988) 87).

#include "solver/calibration/calibration.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// A value of the parameter, and what the others leave there.
struct ProfilePoint {
  double value = 0.0;
  double deviations = 0.0;     ///< sqrt((S - S_min) / s^2), negative below the estimate
  std::vector<double> others;  ///< their estimates
};

struct ProfileInterval {
  double lower_95 = 0.0, upper_95 = 0.0;
  bool lower_open = false, upper_open = false;  ///< the data allow everything up to the bound
  std::vector<ProfilePoint> points;             ///< that were tried, and the estimate; by value
  /// Where the sum of squares is smaller than at the estimate: the fit has not found its minimum.
  std::optional<ProfilePoint> better = std::nullopt;
  int evaluations = 0;
};

struct ProfileSettings {
  double precision = 0.01;  ///< of the deviations at the ends; between the last points they are interpolated
  int most_points = 12;     ///< on each side
  /// Deviations at the ends; Student's 97.5 % quantile if not given. Larger where the residuals are correlated.
  std::optional<double> due = std::nullopt;
  std::function<void(std::size_t k, double value)> trying = {};  ///< before each fit of the others
};

/// Of parameter k of a fit and its settings. With shared differences the others are estimated on their grid, and to the
/// end from where that leads to the end of the interval. Throws NoConvergence where the model does not on the way.
ProfileInterval profile_interval(const FitProblem& problem, const FitSettings& settings, const FitResult& result,
                                 std::size_t k, const ProfileSettings& how = {});

}  // namespace pfdm
