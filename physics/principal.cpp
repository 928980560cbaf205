#include "physics/principal.h"

namespace pfdm {
namespace {

// Twice the shear modulus between two principal directions, (sigma_i - sigma_j) / (eps_i - eps_j), and its limit.
double shear_slope(const PrincipalAxes& strain, const PrincipalStress& sigma, Index i, Index j) {
  const double apart = strain.value[j] - strain.value[i];
  // Closer than this the quotient has lost half of its digits.
  if (apart > 1e-8 * strain.value.cwiseAbs().maxCoeff()) return (sigma.stress[j] - sigma.stress[i]) / apart;
  return 0.5 * (sigma.slope(i, i) + sigma.slope(j, j)) - sigma.slope(i, j);
}

// Of the pairs 23, 13 and 12.
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

PrincipalAxes principal_axes(const Tensor& a) {
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(a);
  return {.value = solver.eigenvalues(), .direction = solver.eigenvectors()};
}

MandelMatrix tangent(const PrincipalAxes& strain, const PrincipalStress& sigma) {
  const Directions axes = directions(strain);
  return axes.normal * sigma.slope * axes.normal.transpose() +
         axes.shear * shear_slopes(strain, sigma).asDiagonal() * axes.shear.transpose();
}

double tangent_product(const PrincipalAxes& strain, const PrincipalStress& sigma, const Mandel& v) {
  const Directions axes = directions(strain);
  const Vector normal = axes.normal.transpose() * v, shear = axes.shear.transpose() * v;
  return normal.dot(sigma.slope * normal) + shear.dot(shear_slopes(strain, sigma).cwiseProduct(shear));
}

}  // namespace pfdm
