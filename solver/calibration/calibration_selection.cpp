#include "solver/calibration/calibration.h"

#include "solver/linear/dense_algebra.h"

#include <cmath>

namespace pfdm {

double bayesian_information(double sum_of_squares, std::size_t n_residuals, std::size_t n_parameters,
                            double negligible) {
  const auto n = static_cast<double>(n_residuals);
  return n * std::log(sum_of_squares / n + negligible * negligible) + static_cast<double>(n_parameters) * std::log(n);
}

namespace {

using Set = std::vector<bool>;  // entries that may be positive

Eigen::VectorXd solve_within(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Set& free) {
  Eigen::MatrixXd part(A.rows(), 0);
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    if (free[j]) {
      part.conservativeResize(Eigen::NoChange, part.cols() + 1);
      part.col(part.cols() - 1) = A.col(j);
    }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(A.cols());
  if (part.cols() == 0) return all;
  const Eigen::VectorXd x = least_squares(part, b);
  for (Eigen::Index j = 0, k = 0; j < A.cols(); ++j)
    if (free[j]) all[j] = x[k++];
  return all;
}

/// Goes from x towards the solution as far as no entry turns negative; entries that come to zero leave the set.
void approach(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, Eigen::VectorXd& x, Set& free) {
  for (Eigen::Index turn = 0; turn <= A.cols(); ++turn) {
    const Eigen::VectorXd wanted = solve_within(A, b, free);
    double length = 1.0;
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (free[j] && wanted[j] <= 0.0) length = std::min(length, x[j] / (x[j] - wanted[j]));
    x += length * (wanted - x);
    if (length == 1.0) return;
    const double zero = 1e-14 * x.lpNorm<Eigen::Infinity>();
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (free[j] && x[j] <= zero) {
        free[j] = false;
        x[j] = 0.0;
      }
  }
}

}  // namespace

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  Set free(A.cols(), false);
  const Eigen::VectorXd size = A.colwise().norm();
  for (Eigen::Index turn = 0; turn < 3 * A.cols(); ++turn) {
    const Eigen::VectorXd gain = A.transpose() * (b - A * x);
    Eigen::Index best = -1;
    double largest = 1e-12 * b.norm();
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (!free[j] && size[j] > 0.0 && gain[j] / size[j] > largest) {
        largest = gain[j] / size[j];
        best = j;
      }
    if (best < 0) break;
    free[best] = true;
    approach(A, b, x, free);
  }
  return x;
}

}  // namespace pfdm
