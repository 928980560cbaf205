#pragma once
// Nonlinear least squares within bounds by the method of Levenberg and Marquardt. All fits end here; Ceres is used in
// levenberg_marquardt.cpp only.

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace pfdm {

struct LeastSquaresProblem {
  /// Residuals at x, always as many; nothing where there are none, from where the step is taken back.
  std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd& x)> residuals;
  /// d residual_i / d x_j; nothing ends the search. By central differences if there is no such function.
  std::function<std::optional<Eigen::MatrixXd>(const Eigen::VectorXd& x)> jacobian = {};
  std::vector<std::pair<double, double>> bounds = {};  ///< of each entry of x; empty: none
};

struct LeastSquaresPoint {
  Eigen::VectorXd x;
  double cost = std::numeric_limits<double>::infinity();  ///< half the sum of the squares
};

struct LeastSquaresSettings {
  int maximum_iterations = 100;
  double tolerance = 1e-10;       ///< relative change of x
  double cost_tolerance = 1e-10;  ///< relative change of the sum of squares
  double least_step = 0.0;        ///< a shorter step ends the search
  double trust_radius = 1e4;      ///< of the first step
  double robust_scale = 0.0;      ///< residuals well above count less (Huber); 0: least squares
  /// A search ends that would not come down to this cost in the iterations that are left, though each took several
  /// times as much from it as the last ones.
  double due_cost = std::numeric_limits<double>::infinity();
  std::function<void(const LeastSquaresPoint&)> iterated = {};  ///< at the start and after every step that was taken
};

struct LeastSquaresResult {
  Eigen::VectorXd x;
  double cost = std::numeric_limits<double>::infinity();  ///< likewise; infinite if nothing could be minimised
  bool converged = false;
  std::string message;  ///< what ended the search
  std::vector<LeastSquaresPoint> path;
};

/// A start without residuals comes back with an infinite cost. Throws nothing of its own.
LeastSquaresResult minimise(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                            const LeastSquaresSettings& settings = {});

/// -1 at the lower bound, 1 at the upper one, 0 between.
int side_of_bound(double x, const std::pair<double, double>& bounds);

}  // namespace pfdm
