#include "solver/calibration/residual_emulator.h"

#include "solver/linear/dense_algebra.h"

#include <utility>

namespace pfdm {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// All products of up to `degree` coordinates.
VectorXd monomials(const VectorXd& z, int degree) {
  std::vector<double> all{1.0};
  struct Product {
    double value;
    Eigen::Index last;
  };
  std::vector<Product> products{{1.0, 0}};
  for (int d = 0; d < degree; ++d) {
    std::vector<Product> next;
    for (const Product& p : products)
      for (Eigen::Index j = p.last; j < z.size(); ++j) next.push_back({p.value * z[j], j});
    for (const Product& p : next) all.push_back(p.value);
    products = std::move(next);
  }
  return VectorXd::Map(all.data(), std::ssize(all));
}

}  // namespace

void ResidualEmulator::add(const VectorXd& z, const std::vector<double>& residuals) {
  points_.push_back(z);
  residuals_.emplace_back(VectorXd::Map(residuals.data(), std::ssize(residuals)));
}

VectorXd ResidualEmulator::reach() const {
  VectorXd most = VectorXd::Zero(n_coordinates_);
  for (const VectorXd& z : points_) most = most.cwiseMax(z.cwiseAbs());
  return most;
}

void ResidualEmulator::fit(double variance) {
  degree_ = 2;
  const auto n = std::ssize(points_);
  if (n >= 3 * n_monomials(3) / 2) degree_ = 3;
  const Eigen::Index q = n_monomials(degree_), m = residuals_.front().size();
  MatrixXd A(n, q), R(n, m);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.row(i) = monomials(points_[i], degree_).transpose();
    R.row(i) = residuals_[i].transpose();
  }
  MatrixXd normal = A.transpose() * A;
  normal.diagonal().array() += 1e-10 * normal.diagonal().maxCoeff();
  const MatrixXd inverse = inverse_of_symmetric(normal);
  coefficients_ = inverse * (A.transpose() * R);
  const VectorXd leverage = (A * inverse).cwiseProduct(A).rowwise().sum();
  const MatrixXd misses =
      (1.0 - leverage.array()).max(1e-3).inverse().matrix().asDiagonal() * (R - A * coefficients_);  // one left out
  variances_ = 1.0 + misses.colwise().squaredNorm().transpose().array() / (static_cast<double>(n) * variance);
  left_out_ = R - misses;
  given_ = std::move(R);
}

VectorXd ResidualEmulator::monomials_at(const VectorXd& z) const { return monomials(z, degree_); }

Eigen::Index ResidualEmulator::n_monomials(int degree) const {
  return monomials(VectorXd::Zero(n_coordinates_), degree).size();
}

}  // namespace pfdm
