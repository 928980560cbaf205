#pragma once
// Nonlinear least squares by Levenberg and Marquardt's method. The only place that knows Eigen's version of MINPACK.

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace pfdm {

struct LeastSquaresProblem {
  Eigen::Index n_residuals = 0;
  Eigen::Index n_parameters = 0;
  /// Residuals that are not finite mean "not here": the step is taken back.
  std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals)> residuals;
  std::function<void(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian)> jacobian;
};

struct LeastSquaresResult {
  Eigen::VectorXd parameters;
  std::vector<double> path;  ///< norm of the residuals after each iteration
  bool converged = false;    ///< false: at the limit of the iterations, or the start has no finite residuals
};

/// Until neither the sum of squares nor the parameters change by more than `tolerance` (relative).
LeastSquaresResult minimise(const LeastSquaresProblem& problem, const Eigen::VectorXd& start, double tolerance = 1e-10,
                            int maximum_iterations = 60);

/// Minimum of a sum of squares linear in the parameters, |A p - q|^2, all columns brought to the same norm first; by QR
/// with pivots, because the normal equations would square the condition number.
Eigen::VectorXd solve_scaled(const Eigen::MatrixXd& A, const Eigen::VectorXd& q);

}  // namespace pfdm
