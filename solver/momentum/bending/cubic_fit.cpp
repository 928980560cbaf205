#include "solver/momentum/bending/cubic_fit.h"

#include "mesh/fields.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

namespace cubic {
namespace {

double power(double x, int n) { return n == 0 ? 1.0 : (n == 1 ? x : (n == 2 ? x * x : x * x * x)); }

}  // namespace

int degree(int k) {
  const auto& p = powers[k];
  return p[0] + p[1] + p[2];
}

Row monomials(const Vector& x) {
  Row row;
  for (int k = 0; k < n_monomials; ++k) {
    const auto& p = powers[k];
    row[k] = power(x[0], p[0]) * power(x[1], p[1]) * power(x[2], p[2]);
  }
  return row;
}

Row derivative(const Vector& x, int a) {
  Row row;
  for (int k = 0; k < n_monomials; ++k) {
    double value = 1.0;
    for (int b = 0; b < 3; ++b) {
      const int p = powers[k][b];
      value *= b != a ? power(x[b], p) : (p == 0 ? 0.0 : p * power(x[b], p - 1));
    }
    row[k] = value;
  }
  return row;
}

// Lagrange; Gauss's rule of two points is exact for cubics.
std::array<double, 4> mean_weights(const std::array<double, 4>& places, std::size_t n) {
  const double gauss = 0.5 / std::sqrt(3.0);
  std::array<double, 4> weights{};
  for (const double x : {-gauss, gauss})
    for (std::size_t j = 0; j < n; ++j) {
      double product = 0.5;
      for (std::size_t m = 0; m < n; ++m)
        if (m != j) product *= (x - places[m]) / (places[j] - places[m]);
      weights[j] += product;
    }
  return weights;
}

}  // namespace cubic

using cubic::n_monomials;

CubicFit::CubicFit(const std::vector<Vector>& places, const cubic::Wanted& wanted)
    : solution_(Eigen::MatrixXd::Zero(n_monomials, static_cast<Eigen::Index>(places.size()))) {
  const Eigen::Index m = solution_.cols();
  Eigen::MatrixXd A(m, n_monomials);
  Eigen::VectorXd weight(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const Vector& place = places[j];
    weight[j] = std::pow(place.norm(), -3.0);
    A.row(j) = weight[j] * cubic::monomials(place);
  }
  orthogonalise(A, wanted);
  Eigen::MatrixXd X = Q_.leftCols(n_).transpose() * weight.asDiagonal();
  R_.topLeftCorner(n_, n_).triangularView<Eigen::Upper>().solveInPlace(X);
  for (Eigen::Index i = 0; i < n_; ++i) solution_.row(kept_[i]) = X.row(i);
}

// A column that is almost a combination of those before is left out.
void CubicFit::orthogonalise(const Eigen::MatrixXd& A, const cubic::Wanted& wanted) {
  constexpr double least_share = 1e-3, rounding = 1e-6;
  Q_.resize(A.rows(), n_monomials);
  R_ = Eigen::MatrixXd::Zero(n_monomials, n_monomials);
  for (int k = 0; k < n_monomials; ++k) {
    if (!wanted[k]) continue;
    Eigen::VectorXd column = A.col(k), along = Eigen::VectorXd::Zero(n_);
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd more = Q_.leftCols(n_).transpose() * column;
      column -= Q_.leftCols(n_) * more;
      along += more;
    }
    if (column.norm() <= std::max(rounding, least_share * A.col(k).norm())) {
      is_sound_ = is_sound_ && cubic::degree(k) > 1;
      continue;
    }
    R_.col(n_).head(n_) = along;
    R_(n_, n_) = column.norm();
    Q_.col(n_++) = column.normalized();
    kept_.push_back(k);
  }
}

}  // namespace pfdm
