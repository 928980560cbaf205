#include "solver/fracture/damage/fatigue_cells.h"

#include "physics/error.h"
#include "solver/fracture/damage/cycled_fatigue.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace pfdm {

bool has_fatigue(const RegionModel& region) { return region.damageable && region.fatigue.is_chosen(); }

bool has_fatigue(const Mesh& mesh, const FractureModel& model) {
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (has_fatigue(model.in_cell(mesh, c))) return true;
  return false;
}

FatigueState FatigueCells::virgin() const {
  const CellField<double> zero(mesh_.n_cells(), 0.0);
  return {.energy = zero, .active = zero, .spent = zero, .cycle_start = {}, .cycle_growth = {}};
}

CellField<double> FatigueCells::factors(const FatigueState& fatigue) const {
  CellField<double> factors(mesh_.n_cells(), 1.0);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (const RegionModel& region = model_.in_cell(mesh_, c); has_fatigue(region))
      factors[c] = region.fatigue.factor(fatigue.energy[c]);
  });
  return factors;
}

void FatigueCells::end_step(const CellField<double>& psi_plus, DamageEquation& damage, FractureState& state) const {
  FatigueState& fatigue = state.fatigue;
  const CellField<double> d = damage.stiffness_damage().of(state.damage);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const RegionModel& region = model_.in_cell(mesh_, c);
    if (!has_fatigue(region)) return;
    const double active = model_.degradation_of(region).g(d[c]) * psi_plus[c];
    fatigue.energy[c] += std::max(active - fatigue.active[c], 0.0);
    fatigue.active[c] = active;
  });
  lower_toughness(damage, state);
}

// From the toughness that the damage equation has to that of the state's fatigue: its fall takes surface energy from
// the damage that is there, which has been dissipated.
void FatigueCells::lower_toughness(DamageEquation& damage, FractureState& state) const {
  if (factors(state.fatigue) == damage.toughness_factor()) return;
  damage.renewed_fracture_energy(state.damage);
  const CellField<double> before = damage.fracture_energy_density(state.damage);
  set_toughness(state, damage);
  const CellField<double> after = damage.fracture_energy_density(state.damage);
  parallel_for(mesh_.n_cells(), [&](Index c) { state.fatigue.spent[c] += before[c] - after[c]; });
}

double FatigueCells::spent_energy(const FatigueState& fatigue) const {
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * fatigue.spent[c]; });
}

void FatigueCells::add_spent(const FatigueState& fatigue, CellField<double>& density) const {
  for (Index c = 0; c < mesh_.n_cells(); ++c) density[c] += fatigue.spent[c];
}

std::optional<FatigueReport> FatigueCells::report(const FractureState& state) const {
  const FatigueState& fatigue = state.fatigue;
  FatigueReport report{.jumped_cycles = fatigue.jumped_cycles};
  report.greatest_energy = parallel_max(mesh_.n_cells(), [&](Index c) {
    const RegionModel& region = model_.in_cell(mesh_, c);
    return has_fatigue(region) ? fatigue.energy[c] / region.fatigue.threshold() : 0.0;
  });
  const CellField<double> f = factors(fatigue);
  report.least_factor = 1.0 - parallel_max(mesh_.n_cells(), [&](Index c) { return 1.0 - f[c]; });
  return report;
}

void FatigueCells::show(const FatigueState& fatigue, std::vector<OutputHistory>& fields) const {
  fields.push_back({.name = "fatigue_energy", .unit = "J/m^3", .scalar = fatigue.energy});
  fields.push_back({.name = "toughness_factor", .unit = "1", .scalar = factors(fatigue)});
}

std::string FatigueCells::remark(FatigueWork& work, const FractureState& state) const { return work.remark(state); }

std::string FatigueWork::remark(const FractureState& state) {
  constexpr double bearable = 0.1;
  if (said_) return {};
  const EnergyAccount& now = state.energy;
  if (!first_) first_ = now;
  largest_ = std::max(largest_, supplied(now) - supplied(*first_));
  const double missing = left_over(*first_, *first_) - left_over(*first_, now);
  if (!(missing > bearable * largest_) || !(now.fracture > first_->fracture)) return {};
  said_ = true;
  return fmt::format(
      "at load {:.6g} the stored and the surface energy exceed the work by {:.0f} %: cracks grow at peaks of the load "
      "at which the work is not followed; take more parts of a cycle (fatigue.steps), and a load that is held at its "
      "peaks for a part of the cycle",
      state.load, 100.0 * missing / largest_);
}

void require_fatigue(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading) {
  const auto refuse = [](std::string_view what, const std::string& with) {
    throw InputError(fmt::format("{} cannot be combined with {}", what, with));
  };
  const bool has_cycles = model.fatigue_cycles.any();
  if (!has_fatigue(mesh, model)) {
    if (has_cycles) throw InputError("[fatigue] requires a damageable material with fatigue, as in fatigue = { ... }");
    return;
  }
  constexpr std::string_view fatigue = "fatigue ([materials.NAME] fatigue)";
  for (const RegionModel& region : model.regions) {
    if (!has_fatigue(region)) continue;
    if (region.material)
      refuse(fatigue, fmt::format("the law \"{}\": the materials have to be linear elastic", region.material->name()));
    if (region.strength.is_chosen())
      refuse(fatigue, "a model of strength, whose coefficients are those of one toughness");
  }
  if (loading.controls_dissipation())
    refuse(fatigue, "dissipation control (loading.maximum_dissipation): the loads of cycles are not proportional to t");
  if (model.heat && model.heat->cycle > 0.0)
    refuse(fatigue, "cycles of heat ([heat] cycle), which end the run once their heat repeats");
  if (model.fatigue_cycles.cycle > loading.end * (1.0 + 1e-9))
    throw InputError(
        fmt::format("a cycle (fatigue.cycle) takes {:g} of t, and the load ends before, at {:g}: expected "
                    "loading.end = {:g} or more",
                    model.fatigue_cycles.cycle, loading.end, model.fatigue_cycles.cycle));
  if (!(model.fatigue_cycles.jump_tolerance > 0.0)) return;
  constexpr std::string_view jumps = "jumps over cycles (fatigue.jump_tolerance)";
  if (model.heat) refuse(jumps, "heat ([heat]): they leave out what the cycles warm");
  if (!model.interfaces.empty()) refuse(jumps, "cohesive interfaces, whose history they do not extrapolate");
  if (model.viscosity > 0.0) refuse(jumps, "viscosity (fracture.viscosity): they leave out the time of the cycles");
  require_periodic(mesh, model, loading.end);
}

}  // namespace pfdm
