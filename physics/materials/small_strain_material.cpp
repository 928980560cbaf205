#include "physics/materials/small_strain_material.h"

namespace pfdm {
namespace {

// Mandel components of a displacement gradient's symmetric part.
Eigen::Matrix<double, 6, 9> make_symmetriser() {
  Eigen::Matrix<double, 6, 9> B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Tensor H = Tensor::Zero();
      H(i, j) = 1.0;
      B.col(3 * i + j) = to_mandel(symmetric_part(H));
    }
  return B;
}

const Eigen::Matrix<double, 6, 9>& symmetriser() {
  static const Eigen::Matrix<double, 6, 9> B = make_symmetriser();
  return B;
}

Mandel strain_of(const Tensor& H) { return to_mandel(symmetric_part(H)); }

}  // namespace

GradientTangent by_gradient(const MandelMatrix& C) { return symmetriser().transpose() * C * symmetriser(); }

// The columns of the symmetriser's transpose are orthonormal.
MandelMatrix by_strain(const GradientTangent& A) { return symmetriser() * A * symmetriser().transpose(); }

MaterialResponse SmallStrainMaterial::update(const MaterialStep& step, std::span<double> history) const {
  const Response response =
      update_strain({strain_of(step.from), strain_of(step.to), step.duration, step.history}, history);
  return {.stress = to_tensor(response.stress), .tangent = by_gradient(response.tangent), .solved = response.solved};
}

MaterialResponse SmallStrainMaterial::elastic(const Tensor& H, std::span<const double> history) const {
  const MandelMatrix C = stiffness_matrix(elasticity());
  return {.stress = to_tensor(C * (strain_of(H) - inelastic(history).strain)), .tangent = by_gradient(C)};
}

MaterialEnergy SmallStrainMaterial::energy(const Tensor& H, std::span<const double> history,
                                           const EnergySplit& split) const {
  const Inelastic past = inelastic(history);
  const Tensor plastic = to_tensor(past.strain);
  const double psi = split.energy(elasticity(), symmetric_part(H) - plastic).psi_plus;
  return {.driving = split.is_variational() ? psi + past.locked : psi,
          .locked = past.locked,
          .dissipated = past.dissipated,
          .inelastic = plastic};
}

}  // namespace pfdm
