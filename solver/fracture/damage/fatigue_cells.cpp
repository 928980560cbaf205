#include "solver/fracture/damage/fatigue_cells.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

/// Of loads, over the length of a part of a cycle: that of many parts has the error of its sum.
double rounding(double load, double part) { return 1e-9 + 8.0 * std::numeric_limits<double>::epsilon() * load / part; }

bool has_fatigue(const RegionModel& region) { return region.damageable && region.fatigue.is_chosen(); }

bool has_fatigue(const Mesh& mesh, const FractureModel& model) {
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (has_fatigue(model.in_cell(mesh, c))) return true;
  return false;
}

/// How many parts of this length the load has gone through.
double whole_parts(double load, double part) { return std::floor(load / part + rounding(load, part)); }

bool ends_cycle(double load, double cycle) {
  return std::abs(load - cycle * whole_parts(load, cycle)) <= rounding(load, cycle) * cycle;
}

/// Whether f(t) differs by more than rounding between cycles, at some t of the first; the load ends at `end`.
template <class F>
bool changes(const F& f, double cycle, double end) {
  constexpr double close = 1e-6;
  double largest = 0.0, difference = 0.0;
  for (const double share : {0.07, 0.19, 0.31, 0.43, 0.56, 0.69, 0.81, 0.94}) {
    const double t = share * cycle, last = std::floor((end - t) / cycle);
    if (last < 1.0) continue;
    const auto first = f(t);
    for (const double n : {1.0, last}) {
      const auto later = f(t + n * cycle);
      largest = std::max({largest, first.norm(), later.norm()});
      difference = std::max(difference, (later - first).norm());
    }
  }
  return difference > close * largest;
}

/// Of numbers.
bool number_changes(const LoadField<double>& f, const Vector& x, double cycle, double end) {
  return f && changes([&](double t) { return Vector(f(x, t), 0.0, 0.0); }, cycle, end);
}

void require_periodic(const Mesh& mesh, const FractureModel& model, double end) {
  const double cycle = model.fatigue_cycles.cycle;
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format(
        "jumps over cycles (fatigue.jump_tolerance) require loads that are the same in every cycle, of {:g} "
        "in t (fatigue.cycle); {} are not",
        cycle, what));
  };
  for (const BoundaryCondition& condition : model.boundary)
    for (const Patch& patch : mesh.patches) {
      if (patch.name != condition.patch) continue;
      for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
        const Vector& x = mesh.face_centre[f];
        if ((condition.value && changes([&](double t) { return condition.value(x, t); }, cycle, end)) ||
            number_changes(condition.pressure, x, cycle, end))
          refuse(fmt::format("the boundary values of patch \"{}\"", patch.name));
      }
    }
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    for (const LoadField<Vector>* load : {&model.loads.gravity, &model.loads.force})
      if (*load && changes([&](double t) { return (*load)(x, t); }, cycle, end)) refuse("the body forces ([loads])");
    if (number_changes(model.loads.temperature, x, cycle, end)) refuse("the temperatures ([loads])");
    if (const auto& strain = model.in_cell(mesh, c).eigenstrain;
        strain && changes([&](double t) { return (*strain)(x, t); }, cycle, end))
      refuse("the eigenstrains ([materials.NAME] eigenstrain)");
  }
}

}  // namespace

FatigueCells::FatigueCells(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh), model_(model), any_(has_fatigue(mesh, model)) {}

FatigueState FatigueCells::virgin() const {
  if (!any_) return {};
  const CellField<double> zero(mesh_.n_cells(), 0.0);
  FatigueState fatigue{.energy = zero, .active = zero, .spent = zero, .cycle_start = {}, .cycle_growth = {}};
  if (model_.fatigue_cycles.any()) fatigue.cycle_start = zero;
  return fatigue;
}

CellField<double> FatigueCells::factors(const FatigueState& fatigue) const {
  CellField<double> factors(mesh_.n_cells(), 1.0);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (const RegionModel& region = model_.in_cell(mesh_, c); has_fatigue(region))
      factors[c] = region.fatigue.factor(fatigue.energy[c]);
  });
  return factors;
}

void FatigueCells::accumulate(const CellField<double>& psi_plus, const CellField<double>& d,
                              FatigueState& fatigue) const {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const RegionModel& region = model_.in_cell(mesh_, c);
    if (!has_fatigue(region)) return;
    const double active = model_.degradation_of(region).g(d[c]) * psi_plus[c];
    fatigue.energy[c] += std::max(active - fatigue.active[c], 0.0);
    fatigue.active[c] = active;
  });
}

double FatigueCells::spent_energy(const FatigueState& fatigue) const {
  if (!any_) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * fatigue.spent[c]; });
}

double FatigueCells::next_stop(double load, double stop) const {
  const FatigueCycles& cycles = model_.fatigue_cycles;
  if (!any_ || !cycles.any()) return stop;
  const double part = cycles.cycle / static_cast<double>(cycles.steps);
  const double end = part * (whole_parts(load, part) + 1.0);
  return end > stop - rounding(stop, part) * part ? stop : end;
}

void FatigueCells::end_cycle(double load, FatigueState& fatigue) const {
  const FatigueCycles& cycles = model_.fatigue_cycles;
  if (!any_ || !cycles.any() || !ends_cycle(load, cycles.cycle)) return;
  const double whole = whole_parts(load, cycles.cycle);
  if (whole == fatigue.whole_cycles) return;
  fatigue.whole_cycles = whole;
  fatigue.cycle_growth = CellField<double>(mesh_.n_cells(), 0.0);
  parallel_for(mesh_.n_cells(), [&](Index c) { fatigue.cycle_growth[c] = fatigue.energy[c] - fatigue.cycle_start[c]; });
  fatigue.cycle_start = fatigue.energy;
  ++fatigue.computed_cycles;
}

double FatigueCells::largest_fall(const FatigueState& fatigue, double cycles) const {
  return parallel_max(mesh_.n_cells(), [&](Index c) {
    const RegionModel& region = model_.in_cell(mesh_, c);
    if (!has_fatigue(region)) return 0.0;
    const double now = fatigue.energy[c];
    return region.fatigue.factor(now) - region.fatigue.factor(now + cycles * fatigue.cycle_growth[c]);
  });
}

double FatigueCells::cycles_to_jump(const FractureState& state, double stop) const {
  const FatigueCycles& cycles = model_.fatigue_cycles;
  const FatigueState& fatigue = state.fatigue;
  if (!any_ || !cycles.any() || !(cycles.jump_tolerance > 0.0)) return 0.0;
  if (fatigue.computed_cycles < cycles.computed_cycles || !ends_cycle(state.load, cycles.cycle)) return 0.0;
  const double most = whole_parts(stop, cycles.cycle) - whole_parts(state.load, cycles.cycle) - 1.0;
  if (!(most >= 1.0)) return 0.0;
  if (largest_fall(fatigue, most) <= cycles.jump_tolerance) return most;
  double allowed = 0.0, too_many = most;
  while (too_many - allowed > 1.0) {
    const double middle = std::floor(0.5 * (allowed + too_many));
    (largest_fall(fatigue, middle) <= cycles.jump_tolerance ? allowed : too_many) = middle;
  }
  return allowed;
}

void FatigueCells::jump(double cycles, FractureState& state) const {
  FatigueState& fatigue = state.fatigue;
  parallel_for(mesh_.n_cells(), [&](Index c) { fatigue.energy[c] += cycles * fatigue.cycle_growth[c]; });
  fatigue.cycle_start = fatigue.energy;
  fatigue.computed_cycles = 0;
  fatigue.jumped_cycles += cycles;
  fatigue.whole_cycles = std::round(state.load / model_.fatigue_cycles.cycle + cycles);
  state.load = fatigue.whole_cycles * model_.fatigue_cycles.cycle;
}

FatigueReport FatigueCells::report(const FractureState& state) const {
  const FatigueState& fatigue = state.fatigue;
  FatigueReport report{.jumped_cycles = fatigue.jumped_cycles};
  if (model_.fatigue_cycles.any()) report.cycles = state.load / model_.fatigue_cycles.cycle;
  report.greatest_energy = parallel_max(mesh_.n_cells(), [&](Index c) {
    const RegionModel& region = model_.in_cell(mesh_, c);
    return has_fatigue(region) ? fatigue.energy[c] / region.fatigue.threshold() : 0.0;
  });
  const CellField<double> f = factors(fatigue);
  report.least_factor = 1.0 - parallel_max(mesh_.n_cells(), [&](Index c) { return 1.0 - f[c]; });
  return report;
}

void FatigueCells::show(const FatigueState& fatigue, std::vector<OutputHistory>& fields) const {
  if (!any_) return;
  fields.push_back({.name = "fatigue_energy", .unit = "J/m^3", .scalar = fatigue.energy});
  fields.push_back({.name = "toughness_factor", .unit = "1", .scalar = factors(fatigue)});
}

std::string FatigueWork::remark(const FatigueCells& fatigue, const FractureState& state) {
  constexpr double bearable = 0.1;
  if (!fatigue.any() || said_) return {};
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
