#pragma once
// What the Jacobian at the end of a fit tells about its estimates.

#include "solver/calibration_scale.h"

namespace pfdm {

/// Fills in estimates, covariance, correlation, warnings, residuals and sums at the scaled parameters u.
void add_statistics(const ScaledModel& model, const Eigen::VectorXd& u, FitResult& result);

/// The value that Student's t with so many degrees of freedom exceeds in size with a probability of 5 %.
double student_95(double degrees_of_freedom);

}  // namespace pfdm
