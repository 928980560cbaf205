#include "physics/materials/small_strain_material.h"

#include <algorithm>
#include <numbers>

namespace pfdm {
namespace {

// The Mandel component that each component of a displacement gradient (row 3 i + j) belongs to, and its share of it.
constexpr Index component[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
constexpr double half_root = 0.5 * std::numbers::sqrt2;
constexpr double share[9] = {1.0, half_root, half_root, half_root, 1.0, half_root, half_root, half_root, 1.0};

Mandel strain_of(const Tensor& H) { return to_mandel(symmetric_part(H)); }

}  // namespace

GradientTangent by_gradient(const MandelMatrix& C) {
  GradientTangent A;
  for (Index k = 0; k < 9; ++k)
    for (Index i = 0; i < 9; ++i) A(i, k) = share[i] * share[k] * C(component[i], component[k]);
  return A;
}

MandelMatrix by_strain(const GradientTangent& A) {
  MandelMatrix C = MandelMatrix::Zero();
  for (Index k = 0; k < 9; ++k)
    for (Index i = 0; i < 9; ++i) C(component[i], component[k]) += share[i] * share[k] * A(i, k);
  return C;
}

MaterialResponse SmallStrainMaterial::update(const MaterialStep& step, std::span<double> history) const {
  const Response response =
      update_strain({strain_of(step.from), strain_of(step.to), step.duration, step.history}, history);
  return {.stress = to_tensor(response.stress), .tangent = by_gradient(response.tangent), .solved = response.solved};
}

Tensor SmallStrainMaterial::stress(const Tensor& H, std::span<const double> history) const {
  return pfdm::stress(elasticity(), symmetric_part(H) - to_tensor(inelastic(history).strain));
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

// As a radial return leaves s of s + 2 mu flow. Where the flow has turned against the stress, that at which the law
// flows counts.
double SmallStrainMaterial::left_by_flow(const MaterialStep& step, std::span<const double> history) const {
  if (!flows()) return 1.0;
  const Mandel flow = inelastic(history).strain - inelastic(step.history).strain;
  const double length = flow.norm();
  if (!(length > 0.0)) return 1.0;
  const double along = flow.dot(to_mandel(stress(step.to, history))) / length;
  const double rate = step.duration > 0.0 ? length / step.duration : 0.0;
  const double s = std::max(along, flow_stress(history, rate));
  return s > 0.0 ? s / (s + 2.0 * elasticity().mu * length) : 1.0;
}

}  // namespace pfdm
