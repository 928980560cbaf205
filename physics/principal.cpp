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

}  // namespace

PrincipalAxes principal_axes(const Tensor& a) {
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(a);
  return {.value = solver.eigenvalues(), .direction = solver.eigenvectors()};
}

MandelMatrix tangent(const PrincipalAxes& strain, const PrincipalStress& sigma) {
  const auto pair = [&](Index i, Index j) {
    const Vector n = strain.direction.col(i), m = strain.direction.col(j);
    return to_mandel(i == j ? Tensor(n * n.transpose())
                            : Tensor((n * m.transpose() + m * n.transpose()) / std::numbers::sqrt2));
  };
  MandelMatrix result = MandelMatrix::Zero();
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < 3; ++j) result += sigma.slope(i, j) * pair(i, i) * pair(j, j).transpose();
    for (Index j = i + 1; j < 3; ++j) {
      const Mandel shear = pair(i, j);
      result += shear_slope(strain, sigma, i, j) * shear * shear.transpose();
    }
  }
  return result;
}

}  // namespace pfdm
