#include "physics/elasticity/anisotropy.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

bool is_positive(const MandelMatrix& A) {
  constexpr double share = 1e-12;  // of the largest eigenvalue
  const Mandel eigenvalues = Eigen::SelfAdjointEigenSolver<MandelMatrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
  return A.allFinite() && eigenvalues[0] > share * eigenvalues[5];
}

// One rotation of Jacobi's method: makes A(p, q) zero; the eigenvectors are the columns of V. Sums in a fixed order.
void rotate(int p, int q, MandelMatrix& A, MandelMatrix& V) {
  if (A(p, q) == 0.0) return;
  const double theta = (A(q, q) - A(p, p)) / (2.0 * A(p, q));
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  const auto turn = [&](double& a, double& b) {
    const double first = a;
    a = c * first - s * b;
    b = s * first + c * b;
  };
  for (int k = 0; k < n_components; ++k) turn(A(k, p), A(k, q));
  for (int k = 0; k < n_components; ++k) turn(A(p, k), A(q, k));
  for (int k = 0; k < n_components; ++k) turn(V(k, p), V(k, q));
}

// Square root of a symmetric, positive matrix.
MandelMatrix square_root(MandelMatrix A) {
  constexpr int sweeps = 12;  // it converges quadratically; six do for rounding
  MandelMatrix V = MandelMatrix::Identity(), root = MandelMatrix::Zero();
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int p = 0; p < n_components; ++p)
      for (int q = p + 1; q < n_components; ++q) rotate(p, q, A, V);
  for (int k = 0; k < n_components; ++k)
    for (int j = 0; j < n_components; ++j)
      for (int i = 0; i < n_components; ++i) root(i, j) += std::sqrt(A(k, k)) * (V(i, k) * V(j, k));
  return root;
}

}  // namespace

AnisotropicElasticity anisotropic_elasticity(const MandelMatrix& C) {
  const MandelMatrix S = C.inverse();
  double compliance = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) compliance += S(i, j);
  return {C, square_root(C), 1.0 / compliance};
}

MandelMatrix orthotropic_stiffness(const OrthotropicConstants& c) {
  MandelMatrix S = MandelMatrix::Zero();
  S(0, 0) = 1.0 / c.E1, S(1, 1) = 1.0 / c.E2, S(2, 2) = 1.0 / c.E3;
  S(0, 1) = S(1, 0) = -c.nu12 / c.E1;
  S(0, 2) = S(2, 0) = -c.nu13 / c.E1;
  S(1, 2) = S(2, 1) = -c.nu23 / c.E2;
  S(3, 3) = 0.5 / c.G23, S(4, 4) = 0.5 / c.G13, S(5, 5) = 0.5 / c.G12;
  if (!is_positive(S)) {
    const double nu21 = c.nu12 * c.E2 / c.E1, nu31 = c.nu13 * c.E3 / c.E1, nu32 = c.nu23 * c.E3 / c.E2;
    const double determinant = 1.0 - c.nu12 * nu21 - c.nu23 * nu32 - c.nu13 * nu31 - 2.0 * nu21 * nu32 * c.nu13;
    throw InputError(fmt::format(
        "the elastic energy of these constants is not positive for every strain: the moduli must be, as 1 - nu12 nu21 "
        "= {:.4g}, 1 - nu13 nu31 = {:.4g}, 1 - nu23 nu32 = {:.4g}, and 1 less these products and 2 nu21 nu32 nu13 = "
        "{:.4g} (nu21 = nu12 E2/E1 ...)",
        1.0 - c.nu12 * nu21, 1.0 - c.nu13 * nu31, 1.0 - c.nu23 * nu32, determinant));
  }
  return S.inverse();
}

MandelMatrix cubic_stiffness(double C11, double C12, double C44) {
  MandelMatrix C = MandelMatrix::Zero();
  C.topLeftCorner<3, 3>().setConstant(C12);
  for (int i = 0; i < 3; ++i) C(i, i) = C11, C(i + 3, i + 3) = 2.0 * C44;
  if (!is_positive(C))
    throw InputError(
        fmt::format("the elastic energy of these constants is not positive for every strain: C44 = {}, C11 - C12 = {} "
                    "and C11 + 2 C12 = {} must be positive",
                    quantity_text(C44, "Pa"), quantity_text(C11 - C12, "Pa"), quantity_text(C11 + 2.0 * C12, "Pa")));
  return C;
}

MandelMatrix general_stiffness(const std::array<double, 21>& voigt) {
  MandelMatrix C;
  std::size_t k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) {
      const double factor = (i > 2 ? std::numbers::sqrt2 : 1.0) * (j > 2 ? std::numbers::sqrt2 : 1.0);
      C(i, j) = C(j, i) = factor * voigt[k++];
    }
  if (!is_positive(C))
    throw InputError(
        "the elastic energy of these constants is not positive for every strain: all eigenvalues of the stiffness must "
        "be positive");
  return C;
}

Tensor axes_along(const Vector& first, const Vector& second) {
  const Vector one = first.normalized();
  const Vector two = second - one.dot(second) * one;
  if (!(first.norm() > 0.0) || !(two.norm() > 1e-6 * second.norm()))
    throw InputError("the two axes must not be zero or parallel");
  Tensor axes;
  axes.col(0) = one;
  axes.col(1) = two.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

MandelMatrix turned(const MandelMatrix& C, const Tensor& axes) {
  MandelMatrix Q;
  for (int k = 0; k < 6; ++k) Q.col(k) = to_mandel(axes * to_tensor(Mandel::Unit(k)) * axes.transpose());
  const MandelMatrix whole = Q * C * Q.transpose();
  return 0.5 * (whole + whole.transpose());
}

Eigen::Matrix<double, 6, 3> strains_across(const Vector& n) {
  Eigen::Matrix<double, 6, 3> strains;
  for (Index k = 0; k < 3; ++k) strains.col(k) = to_mandel(symmetric_part(Vector::Unit(k) * n.transpose()));
  return strains;
}

bool is_symmetric_about(const MandelMatrix& C, const Vector& n) {
  constexpr double close = 1e-9;
  const Vector a = n.unitOrthogonal(), b = n.cross(a);
  for (const Tensor& strain : {Tensor(a * a.transpose()), Tensor(b * b.transpose()), Tensor(n * n.transpose()),
                               symmetric_part(a * b.transpose())}) {
    const Vector traction = to_tensor(C * to_mandel(strain)) * n;
    if ((traction - n.dot(traction) * n).norm() > close * C.norm()) return false;
  }
  return true;
}

}  // namespace pfdm
