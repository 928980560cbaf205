#include "physics/elasticity/principal.h"

#include <array>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

// Twice the shear modulus between two principal directions, (sigma_i - sigma_j) / (eps_i - eps_j), and its limit.
double shear_slope(const PrincipalAxes& strain, const PrincipalStress& sigma, Index i, Index j) {
  const double apart = strain.value[j] - strain.value[i];
  // Closer than this the quotient has lost half of its digits.
  if (apart > 1e-8 * strain.value.cwiseAbs().maxCoeff()) return (sigma.stress[j] - sigma.stress[i]) / apart;
  return 0.5 * (sigma.slope(i, i) + sigma.slope(j, j)) - sigma.slope(i, j);
}

// Shear slopes of the pairs of axes 23, 13 and 12.
Vector shear_slopes(const PrincipalAxes& strain, const PrincipalStress& sigma) {
  return {shear_slope(strain, sigma, 1, 2), shear_slope(strain, sigma, 0, 2), shear_slope(strain, sigma, 0, 1)};
}

// Orthonormal: n_i (x) n_i, and the symmetric parts of n_i (x) n_j times the square root of 2, in the same order.
struct Directions {
  Eigen::Matrix<double, 6, 3> normal, shear;
};

Directions directions(const PrincipalAxes& strain) {
  const Tensor& n = strain.direction;
  Directions axes;
  for (Index i = 0; i < 3; ++i) {
    const Vector one = n.col((i + 1) % 3), other = n.col((i + 2) % 3);
    axes.normal.col(i) = to_mandel(n.col(i) * n.col(i).transpose());
    axes.shear.col(i) = to_mandel((one * other.transpose() + other * one.transpose()) / std::numbers::sqrt2);
  }
  return axes;
}

}  // namespace

namespace {

// Principal axes of a tensor without shear across the plane 12, by the angle of its first axis, 2 phi.
PrincipalAxes axes_in_plane(const Tensor& a) {
  const double half = 0.5 * (a(0, 0) - a(1, 1)), mean = 0.5 * (a(0, 0) + a(1, 1)), shear = a(1, 0);
  const double radius = std::hypot(half, shear), phi = 0.5 * std::atan2(shear, half);
  const double c = std::cos(phi), s = std::sin(phi);
  std::array<std::pair<double, Vector>, 3> axes{
      {{mean - radius, Vector(-s, c, 0.0)}, {mean + radius, Vector(c, s, 0.0)}, {a(2, 2), Vector::UnitZ()}}};
  if (axes[2].first < axes[1].first) std::swap(axes[1], axes[2]);
  if (axes[1].first < axes[0].first) std::swap(axes[0], axes[1]);
  PrincipalAxes sorted;
  for (Index i = 0; i < 3; ++i) {
    const auto& [value, direction] = axes[i];
    sorted.value[i] = value;
    sorted.direction.col(i) = direction;
  }
  return sorted;
}

}  // namespace

PrincipalAxes principal_axes(const Tensor& a) {
  if (a(2, 0) == 0.0 && a(2, 1) == 0.0) return axes_in_plane(a);
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(a);
  return {.value = solver.eigenvalues(), .direction = solver.eigenvectors()};
}

MandelMatrix tangent(const PrincipalAxes& strain, const PrincipalStress& sigma) {
  const Directions axes = directions(strain);
  return axes.normal * sigma.slope * axes.normal.transpose() +
         axes.shear * shear_slopes(strain, sigma).asDiagonal() * axes.shear.transpose();
}

}  // namespace pfdm
