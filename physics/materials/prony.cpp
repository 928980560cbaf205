#include "physics/materials/prony.h"

#include "physics/error.h"
#include "physics/materials/small_strain_material.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace pfdm {
namespace {

double sum_of(const std::vector<PronyBranch>& branches) {
  return std::accumulate(branches.begin(), branches.end(), 0.0,
                         [](double sum, const PronyBranch& branch) { return sum + branch.modulus; });
}

// History: the viscous strains of the shear branches (deviators in Mandel components), then of the bulk branches, then
// the mean viscous strain, by which the stress is C_0 (eps - eps_v), then the heat [J/m^3].
class Prony final : public SmallStrainMaterial {
 public:
  explicit Prony(const PronyLaw& law)
      : SmallStrainMaterial("prony", instantaneous_elasticity(law)),
        law_(law),
        bulk_(6 * law.shear.size()),
        mean_(bulk_ + law.bulk.size()),
        heat_(mean_ + 6) {}

  bool depends_on_rate() const override { return true; }
  IsotropicElasticity relaxed_elasticity() const override { return law_.relaxed; }
  bool has_linear_volume() const override { return true; }
  const PronyLaw* relaxing() const override { return &law_; }
  std::size_t history_size() const override { return heat_ + 1; }
  std::vector<HistoryField> history_fields() const override { return {{"viscous_strain", "1", mean_, 6}}; }

  MaterialEnergy energy(const Tensor& H, std::span<const double> history, const EnergySplit& split) const override {
    MaterialEnergy energy = SmallStrainMaterial::energy(H, history, split);
    if (law_.drive == PronyDrive::stored) return energy;
    const double relaxed = split.energy(law_.relaxed, symmetric_part(H)).psi_plus;
    energy.idle = std::max(energy.driving - relaxed, 0.0);
    energy.driving = relaxed;
    return energy;
  }

 protected:
  Response update_strain(const Step& step, std::span<double> history) const override {
    const Mandel change = step.to - step.from;
    const double mu_0 = elasticity().mu, K_0 = elasticity().bulk_modulus();
    double mu = law_.relaxed.mu, K = law_.relaxed.bulk_modulus(), heat = step.history[heat_];
    Mandel mean = Mandel::Zero();
    for (std::size_t i = 0; i < law_.shear.size(); ++i) {
      const PronyDecay by = decay_over(step.duration / law_.shear[i].time);
      const Mandel before = Eigen::Map<const Mandel>(step.history.data() + 6 * i);
      const Mandel q_n = deviator(step.from) - before, de = deviator(change), q = by.after(q_n, de);
      const Mandel viscous = deviator(step.to) - q;
      Eigen::Map<Mandel>(history.data() + 6 * i) = viscous;
      mean += law_.shear[i].modulus / mu_0 * viscous;
      mu += by.phi * law_.shear[i].modulus;
      heat += law_.shear[i].modulus *
              std::max(2.0 * de.dot(by.phi * q_n + by.second * de) - q.squaredNorm() + q_n.squaredNorm(), 0.0);
    }
    for (std::size_t j = 0; j < law_.bulk.size(); ++j) {
      const PronyDecay by = decay_over(step.duration / law_.bulk[j].time);
      const double r_n = trace(step.from) - step.history[bulk_ + j], dv = trace(change);
      const double r = by.after(r_n, dv);
      history[bulk_ + j] = trace(step.to) - r;
      mean += law_.bulk[j].modulus / K_0 * history[bulk_ + j] / 3.0 * mandel_identity();
      K += by.phi * law_.bulk[j].modulus;
      heat +=
          0.5 * law_.bulk[j].modulus * std::max(2.0 * dv * (by.phi * r_n + by.second * dv) - r * r + r_n * r_n, 0.0);
    }
    Eigen::Map<Mandel>(history.data() + mean_) = mean;
    history[heat_] = heat;
    return {.stress = stiffness_matrix(elasticity()) * (step.to - mean),
            .tangent = stiffness_matrix({.lambda = K - 2.0 * mu / 3.0, .mu = mu})};
  }

  // Inelastic strain, and the energy that the springs store beside the instantaneous elasticity at the strain less the
  // mean viscous one.
  Inelastic inelastic(std::span<const double> history) const override {
    const Mandel mean = Eigen::Map<const Mandel>(history.data() + mean_);
    double locked =
        -elasticity().mu * deviator(mean).squaredNorm() - 0.5 * elasticity().bulk_modulus() * trace(mean) * trace(mean);
    for (std::size_t i = 0; i < law_.shear.size(); ++i)
      locked += law_.shear[i].modulus * Eigen::Map<const Mandel>(history.data() + 6 * i).squaredNorm();
    for (std::size_t j = 0; j < law_.bulk.size(); ++j)
      locked += 0.5 * law_.bulk[j].modulus * history[bulk_ + j] * history[bulk_ + j];
    return {.strain = mean, .locked = locked, .dissipated = history[heat_]};
  }

 private:
  PronyLaw law_;
  std::size_t bulk_, mean_, heat_;  // places in the history
};

}  // namespace

IsotropicElasticity instantaneous_elasticity(const PronyLaw& law) {
  const double mu = law.relaxed.mu + sum_of(law.shear), K = law.relaxed.bulk_modulus() + sum_of(law.bulk);
  return {.lambda = K - 2.0 * mu / 3.0, .mu = mu};
}

IsotropicElasticity elasticity_over(const PronyLaw& law, double duration) {
  double mu = law.relaxed.mu, K = law.relaxed.bulk_modulus();
  for (const PronyBranch& branch : law.shear) mu += decay_over(duration / branch.time).phi * branch.modulus;
  for (const PronyBranch& branch : law.bulk) K += decay_over(duration / branch.time).phi * branch.modulus;
  return {.lambda = K - 2.0 * mu / 3.0, .mu = mu};
}

void require_branches(const PronyLaw& law) {
  for (const auto* branches : {&law.shear, &law.bulk})
    for (const PronyBranch& branch : *branches)
      if (!(branch.modulus > 0.0 && branch.time > 0.0))
        throw InputError(fmt::format("a Prony branch with the modulus {} and the time {} s: both must be positive",
                                     quantity_text(branch.modulus, "Pa", 6), branch.time));
}

std::shared_ptr<const Material> make_prony(const PronyLaw& law) {
  require_branches(law);
  if (law.shear.empty() && law.bulk.empty())
    throw InputError(
        "a material of the law \"prony\" needs shear_branches or bulk_branches, as in shear_branches = "
        "[{ modulus = \"1 MPa\", time = \"0.1 s\" }]");
  return std::make_shared<const Prony>(law);
}

}  // namespace pfdm
