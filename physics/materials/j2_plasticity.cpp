#include "physics/materials/j2_plasticity.h"

#include "physics/error.h"
#include "physics/materials/small_strain_material.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double sqrt_2_3 = std::numbers::sqrt2 / std::numbers::sqrt3;

class J2Plasticity final : public SmallStrainMaterial {
 public:
  J2Plasticity(const IsotropicElasticity& elasticity, const J2Parameters& law)
      : SmallStrainMaterial("j2_plasticity", elasticity), law_(law) {}

  bool has_linear_volume() const override { return true; }
  bool flows() const override { return true; }
  std::size_t history_size() const override { return n_numbers; }
  std::vector<HistoryField> history_fields() const override {
    return {{"plastic_strain", "1", plastic_strain, 6}, {"equivalent_plastic_strain", "1", equivalent, 1}};
  }

 protected:
  // Radial return: the direction n of the trial stress is that of the end.
  Response update_strain(const Step& step, std::span<double> history) const override {
    const double mu = elasticity().mu, K = law_.isotropic_hardening, H = law_.kinematic_hardening;
    const Mandel before = Eigen::Map<const Mandel>(step.history.data());
    const MandelMatrix C = stiffness_matrix(elasticity());
    const Mandel trial = C * (step.to - before);
    const Mandel relative = deviator(trial) - (2.0 / 3.0) * H * before;
    const double length = relative.norm();
    const double excess = length - sqrt_2_3 * (law_.yield_stress + K * step.history[equivalent]);
    if (!std::isfinite(excess)) return {.stress = trial, .tangent = C, .solved = false};
    std::ranges::copy(step.history, history.begin());
    if (excess <= 0.0) return {.stress = trial, .tangent = C};
    const Mandel n = relative / length;
    const double slope = 2.0 * mu + (2.0 / 3.0) * (K + H), flow = excess / slope;
    Eigen::Map<Mandel>(history.data()) += flow * n;
    history[equivalent] += sqrt_2_3 * flow;
    const double turning = 2.0 * mu * flow / length;  // share of the tangent that the return along n takes away
    return {.stress = trial - 2.0 * mu * flow * n,
            .tangent = C - 2.0 * mu * turning * deviatoric_projector() -
                       2.0 * mu * (2.0 * mu / slope - turning) * (n * n.transpose())};
  }

  // Hardening stores what it adds to the yield stress; the initial yield stress makes heat.
  Inelastic inelastic(std::span<const double> history) const override {
    const Mandel strain = Eigen::Map<const Mandel>(history.data());
    const double p = history[equivalent];
    return {.strain = strain,
            .locked = 0.5 * law_.isotropic_hardening * p * p + law_.kinematic_hardening * strain.squaredNorm() / 3.0,
            .dissipated = law_.yield_stress * p};
  }
  double flow_stress(std::span<const double> history, double) const override {
    return sqrt_2_3 * (law_.yield_stress + law_.isotropic_hardening * history[equivalent]);
  }

 private:
  static constexpr std::size_t plastic_strain = 0, equivalent = 6, n_numbers = 7;  // places in the history

  J2Parameters law_;
};

}  // namespace

std::shared_ptr<const Material> make_j2_plasticity(const IsotropicElasticity& elasticity, const J2Parameters& law) {
  if (!(law.yield_stress > 0.0 && law.isotropic_hardening >= 0.0 && law.kinematic_hardening >= 0.0))
    throw InputError(
        fmt::format("J2 plasticity with yield stress {}, isotropic hardening {} and kinematic hardening {}: the first "
                    "must be positive, the others must not be negative",
                    quantity_text(law.yield_stress, "Pa", 6), quantity_text(law.isotropic_hardening, "Pa", 6),
                    quantity_text(law.kinematic_hardening, "Pa", 6)));
  return std::make_shared<const J2Plasticity>(elasticity, law);
}

}  // namespace pfdm
