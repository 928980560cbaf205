#pragma once
// Statistics of a fit's estimates from the Jacobian at its end.

#include "solver/calibration/calibration_scale.h"

#include <vector>

namespace pfdm {

/// Fills in estimates, covariance, correlation, warnings, residuals and sums at the scaled parameters u. Throws
/// NoConvergence if the model does not converge there, or beside on both sides of a parameter, nor about the grid
/// point.
void add_statistics(const ScaledModel& model, const Eigen::VectorXd& u, FitResult& result);

/// The value that Student's t with so many degrees of freedom exceeds in size with the probability 1 - confidence.
double student_quantile(double confidence, double degrees_of_freedom);
double student_95(double degrees_of_freedom);
/// The value that this share of the values, one at least, does not exceed.
double quantile(std::vector<double> values, double share);
/// Of samples, as of a posterior: the median, and the ends between which 95 % of them lie.
struct SampledInterval {
  double median = 0.0, lower = 0.0, upper = 0.0;
};
SampledInterval interval_of(const std::vector<double>& samples);
/// Number of independent samples that a chain of correlated ones is as good as, of the coordinate that has fewest: by
/// how much means over stretches of the chain vary.
double effective_number(const std::vector<Eigen::VectorXd>& chain);

}  // namespace pfdm
