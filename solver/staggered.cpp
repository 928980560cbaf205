#include "solver/staggered.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// FGMRES iterations at most, within the loop and of the last solve.
constexpr Index inner_iterations = 80, last_iterations = 400;

}  // namespace

Staggered::Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                     const StaggeredSettings& settings)
    : mesh_(mesh),
      model_(model),
      settings_(settings),
      momentum_(mesh, unknowns),
      stiffness_(mesh, model),
      damage_(mesh, model, unknowns.plane_normal) {}

StepOutcome Staggered::solve_step(const FractureState& start, FractureState& state, const RunHooks& hooks,
                                  double allowed_growth) {
  StepOutcome outcome;
  Relaxation relaxation;
  stiffness_.start_step();
  momentum_.start_afresh();  // a run that is gone on with does the same
  double energy_before = 0.0;
  bool settled = false;
  while (outcome.iterations < settings_.maximum_iterations && !outcome.converged) {
    degrade(state);
    // Loose while the damage still moves; as tight as the step asks for once it has settled.
    const double floor = 0.1 * settings_.equilibrium_tolerance;
    const double ceiling = settled ? settings_.equilibrium_tolerance : 1e-4;
    // A crack that is closed and sheared is a nearly incompressible liquid, which takes many Krylov iterations: what a
    // few of them leave is left to the next turn of the loop.
    const Equilibrium equilibrium = solve_momentum(
        state, {.reduction = 0.1, .ceiling = ceiling, .floor = floor, .most_iterations = inner_iterations});
    if (!std::isfinite(equilibrium.residual)) return outcome;
    const Energies energies = update_driving_energy(start, state, true);
    CellField<double> answer = state.damage;
    const bool damage_solved = solve_damage(start, state, answer);
    const double change = parallel_max(answer.size(), [&](Index c) { return std::abs(answer[c] - state.damage[c]); });
    const double energy = energies.elastic + damage_.fracture_energy(answer);
    const double energy_change = (std::abs(energy - energy_before) + energies.unsettled) / std::max(energy, 1e-300);
    energy_before = energy;
    ++outcome.iterations;
    outcome.krylov_iterations += equilibrium.iterations;
    settled = damage_solved && change < settings_.damage_tolerance && energy_change < settings_.energy_tolerance;
    outcome.converged = settled && equilibrium.residual <= settings_.equilibrium_tolerance;
    if (outcome.converged)
      state.damage = answer;
    else
      state.damage = relaxation.next(state.damage, answer, start.damage);
    outcome.growth = parallel_max(answer.size(), [&](Index c) { return state.damage[c] - start.damage[c]; });
    outcome.grew_too_much = outcome.growth > allowed_growth;
    if (hooks.iterated)
      hooks.iterated({state.step, outcome.iterations, state.load, change, energy_change, equilibrium.iterations});
    if (outcome.grew_too_much) {
      outcome.converged = false;
      return outcome;
    }
  }
  // Reactions balance, and energies belong to the damage of the step.
  degrade(state);
  const Equilibrium equilibrium =
      solve_momentum(state, {.reduction = 0.0, .ceiling = 3e-8, .floor = 3e-8, .most_iterations = last_iterations});
  outcome.krylov_iterations += equilibrium.iterations;
  outcome.converged = outcome.converged && equilibrium.residual <= settings_.equilibrium_tolerance;
  outcome.elastic_energy = update_driving_energy(start, state, false).elastic;
  return outcome;
}

void Staggered::degrade(const FractureState& state) {
  const auto lap = clock_.lap("moduli_and_preconditioner");
  stiffness_.set(state, momentum_);
}

Equilibrium Staggered::solve_momentum(FractureState& state, const MomentumSolver::Tolerance& tolerance) {
  const auto lap = clock_.lap("momentum");
  return momentum_.solve(state.load, tolerance, state.displacement);
}

Staggered::Energies Staggered::update_driving_energy(const FractureState& start, FractureState& state, bool settles) {
  const auto lap = clock_.lap("driving_energy");
  CellMechanics mechanics =
      momentum_.balance().mechanics(state.displacement, MomentumOperator::Wanted::strain_and_energy);
  const bool history = model_.irreversibility == Irreversibility::history;
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const RegionModel& region = model_.regions[as_size(mesh_.region[c])];
    const double psi = model_.split->energy(region.elasticity, mechanics.strain[c]).psi_plus;
    state.driving_energy[c] = history ? std::max(psi, start.driving_energy[c]) : psi;
  });
  Energies energies;
  energies.elastic = parallel_sum(mesh_.n_cells(), [&](Index c) { return mechanics.energy[c]; });
  if (settles) energies.unsettled = stiffness_.follow(mechanics.strain, state);
  return energies;
}

bool Staggered::solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d) {
  const auto lap = clock_.lap("damage");
  const bool bounds = model_.irreversibility == Irreversibility::bounds;
  const CellField<double> zero(bounds ? 0 : as_size(mesh_.n_cells()), 0.0);
  return damage_.solve(state.driving_energy, bounds ? start.damage : zero, {.reduction = 1e-3}, d).converged;
}

}  // namespace pfdm
