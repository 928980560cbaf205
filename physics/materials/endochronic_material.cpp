#include "physics/materials/endochronic_material.h"

#include "physics/materials/small_strain_material.h"

#include <algorithm>

namespace pfdm {
namespace {

// Places in the history; the stresses of the kernel's terms follow.
constexpr std::size_t plastic_strain = 0, zeta = 6, z = 7, dissipation = 8, terms = 9;

Mandel mandel_at(std::span<const double> history, std::size_t first) {
  return Eigen::Map<const Mandel>(history.data() + first);
}

void put(const Mandel& v, std::size_t first, std::span<double> history) {
  std::ranges::copy(v, history.begin() + first);
}

class EndochronicMaterial final : public SmallStrainMaterial {
 public:
  explicit EndochronicMaterial(EndochronicLaw law)
      : SmallStrainMaterial("endochronic", law.elasticity), law_(std::move(law)) {}

  bool depends_on_rate() const override { return law_.hardening.depends_on_rate(); }
  bool has_linear_volume() const override { return true; }
  bool flows() const override { return true; }
  std::size_t history_size() const override { return terms + 6 * law_.kernel.size(); }
  std::vector<HistoryField> history_fields() const override {
    return {{"plastic_strain", "1", plastic_strain, 6}, {"plastic_path_length", "1", zeta, 1}};
  }

 protected:
  Response update_strain(const Step& step, std::span<double> history) const override {
    const EndochronicUpdate result =
        pfdm::update(law_, state_of(step.history, step.from), step.to - step.from, step.duration);
    if (result.converged) write(result.state, history);
    return {.stress = result.stress, .tangent = result.tangent, .solved = result.converged};
  }

  Inelastic inelastic(std::span<const double> history) const override {
    double locked = 0.0;
    for (std::size_t r = 0; r < law_.kernel.size(); ++r)
      locked += mandel_at(history, terms + 6 * r).squaredNorm() / (4.0 * law_.kernel[r].C);
    return {.strain = mandel_at(history, plastic_strain), .locked = locked, .dissipated = history[dissipation]};
  }
  // What the fading terms of the kernel allow at most.
  double flow_stress(std::span<const double> history, double rate) const override {
    double sum = 0.0;
    for (const auto& [C, alpha] : law_.kernel)
      if (alpha > 0.0) sum += C / alpha;
    return 2.0 * law_.hardening(history[zeta], rate).f * sum;
  }

 private:
  EndochronicState state_of(std::span<const double> history, const Mandel& strain) const {
    EndochronicState state{.strain = strain,
                           .plastic_strain = mandel_at(history, plastic_strain),
                           .s = {},
                           .z = history[z],
                           .zeta = history[zeta],
                           .dissipation = history[dissipation]};
    state.s.reserve(law_.kernel.size());
    for (std::size_t r = 0; r < law_.kernel.size(); ++r) state.s.push_back(mandel_at(history, terms + 6 * r));
    return state;
  }

  static void write(const EndochronicState& state, std::span<double> history) {
    put(state.plastic_strain, plastic_strain, history);
    history[zeta] = state.zeta;
    history[z] = state.z;
    history[dissipation] = state.dissipation;
    for (std::size_t r = 0; r < state.s.size(); ++r) put(state.s[r], terms + 6 * r, history);
  }

  EndochronicLaw law_;
};

}  // namespace

std::shared_ptr<const Material> make_endochronic_material(EndochronicLaw law) {
  check(law);
  return std::make_shared<const EndochronicMaterial>(std::move(law));
}

}  // namespace pfdm
