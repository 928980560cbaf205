#include "solver/fracture/damage/cycled_fatigue.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pfdm {
namespace {

/// Of loads, over the length of a part of a cycle: that of many parts has the error of its sum.
double rounding(double load, double part) { return 1e-9 + 8.0 * std::numeric_limits<double>::epsilon() * load / part; }

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

}  // namespace

FatigueState CycledFatigue::virgin() const {
  FatigueState fatigue = FatigueCells::virgin();
  fatigue.cycle_start = CellField<double>(mesh().n_cells(), 0.0);
  return fatigue;
}

double CycledFatigue::next_stop(double load, double stop) const {
  const FatigueCycles& by = cycles();
  const double part = by.cycle / static_cast<double>(by.steps);
  const double end = part * (whole_parts(load, part) + 1.0);
  return end > stop - rounding(stop, part) * part ? stop : end;
}

void CycledFatigue::end_cycle(double load, FatigueState& fatigue) const {
  const FatigueCycles& by = cycles();
  if (!ends_cycle(load, by.cycle)) return;
  const double whole = whole_parts(load, by.cycle);
  if (whole == fatigue.whole_cycles) return;
  fatigue.whole_cycles = whole;
  fatigue.cycle_growth = CellField<double>(mesh().n_cells(), 0.0);
  parallel_for(mesh().n_cells(),
               [&](Index c) { fatigue.cycle_growth[c] = fatigue.energy[c] - fatigue.cycle_start[c]; });
  fatigue.cycle_start = fatigue.energy;
  ++fatigue.computed_cycles;
}

double CycledFatigue::largest_fall(const FatigueState& fatigue, double cycles) const {
  return parallel_max(mesh().n_cells(), [&](Index c) {
    const RegionModel& region = model().in_cell(mesh(), c);
    if (!has_fatigue(region)) return 0.0;
    const double now = fatigue.energy[c];
    return region.fatigue.factor(now) - region.fatigue.factor(now + cycles * fatigue.cycle_growth[c]);
  });
}

double CycledFatigue::cycles_to_jump(const FractureState& state, double stop) const {
  const FatigueCycles& by = cycles();
  const FatigueState& fatigue = state.fatigue;
  if (!(by.jump_tolerance > 0.0)) return 0.0;
  if (fatigue.computed_cycles < by.computed_cycles || !ends_cycle(state.load, by.cycle)) return 0.0;
  const double most = whole_parts(stop, by.cycle) - whole_parts(state.load, by.cycle) - 1.0;
  if (!(most >= 1.0)) return 0.0;
  if (largest_fall(fatigue, most) <= by.jump_tolerance) return most;
  double allowed = 0.0, too_many = most;
  while (too_many - allowed > 1.0) {
    const double middle = std::floor(0.5 * (allowed + too_many));
    (largest_fall(fatigue, middle) <= by.jump_tolerance ? allowed : too_many) = middle;
  }
  return allowed;
}

void CycledFatigue::jump(double cycles, FractureState& state) const {
  FatigueState& fatigue = state.fatigue;
  parallel_for(mesh().n_cells(), [&](Index c) { fatigue.energy[c] += cycles * fatigue.cycle_growth[c]; });
  fatigue.cycle_start = fatigue.energy;
  fatigue.computed_cycles = 0;
  fatigue.jumped_cycles += cycles;
  fatigue.whole_cycles = std::round(state.load / this->cycles().cycle + cycles);
  state.load = fatigue.whole_cycles * this->cycles().cycle;
}

void CycledFatigue::jump(double cycles, DamageEquation& damage, FractureState& state) const {
  set_toughness(state, damage);
  jump(cycles, state);
  lower_toughness(damage, state);
}

std::optional<FatigueReport> CycledFatigue::report(const FractureState& state) const {
  std::optional<FatigueReport> report = FatigueCells::report(state);
  report->cycles = state.load / cycles().cycle;
  return report;
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

}  // namespace pfdm
