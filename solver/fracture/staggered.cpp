#include "solver/fracture/staggered.h"

#include "solver/fracture/window.h"
#include "solver/parallel.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pfdm {
namespace {

// Largest numbers of FGMRES iterations, within the loop and of the last solve.
constexpr Index inner_iterations = 80, last_iterations = 400;
// Successive iterations in which only the residual stiffness may carry the loads: the first ones are inexact.
constexpr Index torn_at_most = 5;
// Relative residual of the last solve, if no smaller one is required.
constexpr double last_tolerance = 3e-8;

// Windows are around the cells whose damage changes by more than this share of the largest change,
constexpr double changing_share = 0.3;
// reach this number of lengths ell from them, and have at most this share of the cells.
constexpr double window_reach = 2.0, largest_window = 0.4, most_changing = 0.1;
// They iterate until the change has fallen to this share of itself, or
constexpr double window_fall = 0.1;
// to this share of the tolerance.
constexpr double window_precision = 0.5;
constexpr Index window_iterations = 10;
constexpr Index least_cells = 1500;  // of a mesh that has windows

}  // namespace

Staggered::Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                     const StaggeredSettings& settings)
    : mesh_(mesh),
      model_(model),
      unknowns_(unknowns),
      settings_(settings),
      momentum_(mesh, unknowns),
      stiffness_(mesh, model),
      damage_(mesh, model, unknowns.plane_normal) {
  settings_.windows = settings.windows && mesh.n_cells() >= least_cells;
}

StepOutcome Staggered::solve_step(const FractureState& start, FractureState& state, const RunHooks& hooks,
                                  const StepLimits& limits) {
  stiffness_.start_step(limits.duration);
  momentum_.start_afresh();  // as a restarted run does
  StepOutcome outcome = alternate(start, state, hooks, limits);
  if (outcome.failed || outcome.broke_too_much || outcome.collapsed) return outcome;
  // Reactions balance, and energies belong to the damage of the step.
  degrade(state);
  const double tolerance = std::min(last_tolerance, settings_.equilibrium_tolerance);
  const Equilibrium equilibrium = solve_momentum(
      state, {.reduction = 0.0, .ceiling = tolerance, .floor = tolerance, .most_iterations = last_iterations});
  outcome.krylov_iterations += equilibrium.iterations;
  outcome.residual = equilibrium.residual;
  outcome.converged = outcome.converged && equilibrium.residual <= settings_.equilibrium_tolerance;
  const Energies energies = update_driving_energy(start, state, false);
  outcome.elastic_energy = energies.stored;
  outcome.share = residual_share(state, energies);
  outcome.collapsed = outcome.converged && has_collapsed(outcome.share);
  outcome.viscous_dissipation = damage_.viscous_dissipation(state.damage);
  outcome.plastic_dissipation = stiffness_.plastic_dissipation(start, state);
  return outcome;
}

StepOutcome Staggered::alternate(const FractureState& start, FractureState& state, const RunHooks& hooks,
                                 const StepLimits& limits) {
  StepOutcome outcome;
  const bool path_is_followed = std::isfinite(limits.dissipation);
  const double fracture_energy = damage_.renewed_fracture_energy(start.damage);
  PathLimit limit;
  if (path_is_followed) limit = {state.load, fracture_energy + limits.dissipation, limits.dissipation};
  Relaxation relaxation;
  if (model_.viscosity > 0.0) damage_.resist_change(model_.viscosity / limits.duration, start.damage);
  double energy_before = 0.0, stored_at_unit_load = 0.0;
  Index torn = 0;  // successive iterations in which only the residual stiffness carried the loads
  while (outcome.iterations < settings_.maximum_iterations && !outcome.converged) {
    degrade(state);
    // Loose while the damage still changes; as tight as the step requires once it has converged.
    const double floor = 0.1 * settings_.equilibrium_tolerance;
    const double ceiling = outcome.settled ? settings_.equilibrium_tolerance : 1e-4;
    // A crack that is closed and sheared is nearly incompressible and takes many Krylov iterations: the remaining
    // residual is left to the next iteration of the loop.
    const Equilibrium equilibrium = solve_momentum(
        state, {.reduction = 0.1, .ceiling = ceiling, .floor = floor, .most_iterations = inner_iterations});
    outcome.failed = !std::isfinite(equilibrium.residual);
    if (outcome.failed) return outcome;
    FractureState from;
    if (settings_.windows) from = state;
    const Energies energies = update_driving_energy(start, state, true);
    outcome.failed = !std::isfinite(energies.unsettled);
    if (outcome.failed) return outcome;
    if (settings_.windows) from.driving_energy = state.driving_energy;
    if (outcome.iterations == 0) stored_at_unit_load = energies.stored / (state.load * state.load);
    torn = has_collapsed(residual_share(state, energies)) ? torn + 1 : 0;
    outcome.collapsed = torn > torn_at_most;
    if (outcome.collapsed) return outcome;
    const double undamaged = stored_at_unit_load * state.load * state.load;
    outcome.starting_energy = undamaged;
    outcome.energy_release = std::abs(energies.stored - undamaged) / std::max(undamaged + fracture_energy, 1e-300);
    CellField<double> answer = state.damage;
    const double load = state.load;
    const bool damage_solved =
        path_is_followed ? follow_path(start, limit, state, answer) : solve_damage(start, state, answer);
    const double load_scale = state.load / load;
    const double change = parallel_max(answer.size(), [&](Index c) { return std::abs(answer[c] - state.damage[c]); });
    const double energy = load_scale * load_scale * energies.stored + damage_.fracture_energy(answer);
    const double energy_change = (std::abs(energy - energy_before) + energies.unsettled) / std::max(energy, 1e-300);
    energy_before = energy;
    ++outcome.iterations;
    outcome.krylov_iterations += equilibrium.iterations;
    outcome.settled = damage_solved && change < settings_.damage_tolerance &&
                      energy_change < settings_.energy_tolerance &&
                      std::abs(load_scale - 1.0) < settings_.damage_tolerance;
    outcome.residual = equilibrium.residual;
    outcome.converged = outcome.settled && equilibrium.residual <= settings_.equilibrium_tolerance;
    if (outcome.converged)
      state.damage = answer;
    else
      state.damage = relaxation.next(state.damage, answer, start.damage);
    const bool moved_on =
        !outcome.converged && settle_windows(start, {from, answer, change}, limits.duration, state, outcome);
    if (moved_on) relaxation = {};
    outcome.growth = parallel_max(answer.size(), [&](Index c) { return state.damage[c] - start.damage[c]; });
    outcome.broke_too_much = outcome.growth > limits.growth || outcome.energy_release > limits.energy_release;
    if (hooks.iterated)
      hooks.iterated({state.step, outcome.iterations, state.load, change, energy_change, equilibrium.iterations});
    if (outcome.broke_too_much) {
      outcome.converged = false;
      return outcome;
    }
    if (limits.may_be_cut && !outcome.converged && relaxation.goes_in_circles()) return outcome;
  }
  return outcome;
}

// Whether there were any.
bool Staggered::settle_windows(const FractureState& start, const Turn& turn, double duration, FractureState& state,
                               StepOutcome& outcome) {
  if (!settings_.windows) return false;
  const Index n = mesh_.n_cells();
  const auto lap = clock_.lap("windows");
  const double least = std::max(changing_share * turn.change, window_precision * settings_.damage_tolerance);
  std::vector<Index> changing;
  double ell = 0.0;
  for (Index c = 0; c < n; ++c) {
    if (!(std::abs(turn.answer[c] - turn.from.damage[c]) > least)) continue;
    changing.push_back(c);
    ell = std::max(ell, model_.in_cell(mesh_, c).ell);
  }
  if (double(changing.size()) > most_changing * double(n)) return false;
  StaggeredSettings settings = settings_;
  settings.windows = false;
  settings.damage_tolerance = std::max(window_precision * settings_.damage_tolerance, window_fall * turn.change);
  settings.energy_tolerance = std::numeric_limits<double>::infinity();
  settings.maximum_iterations = window_iterations;
  const Window::Surroundings whole{.mesh = mesh_,
                                   .model = model_,
                                   .unknowns = unknowns_,
                                   .start = start,
                                   .state = turn.from,
                                   .face_displacement = face_displacement_,
                                   .damage_equation = damage_,
                                   .stiffness = stiffness_,
                                   .residual_reference = momentum_.residual_reference(),
                                   .duration = duration};
  bool any = false;
  for (std::vector<Index>& cells : window_cells(mesh_, changing, window_reach * ell)) {
    const double share = double(cells.size()) / double(n);
    if (share > largest_window) continue;
    any = true;
    const StepOutcome inner = Window(whole, std::move(cells), settings).settle(state);
    outcome.window_iterations += share * double(inner.iterations);
  }
  return any;
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
  Energies energies{.unsettled = stiffness_.integrate(mechanics, start, state)};
  energies.stored =
      parallel_sum(mesh_.n_cells(), [&](Index c) { return stiffness_.stored_energy(c, mechanics, state); });
  strain_ = std::move(mechanics.strain);
  face_displacement_ = std::move(mechanics.face_displacement);
  energies.residual = drive(start, state, 1.0);
  if (settles) energies.unsettled += stiffness_.follow(strain_, state);
  return energies;
}

// The driving energy of the last equilibrium's strain times `scale`. Returns what the residual stiffness stores [J].
double Staggered::drive(const FractureState& start, FractureState& state, double scale) {
  const bool history = model_.irreversibility == Irreversibility::history;
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    const double psi = stiffness_.driving_energy(c, scale * strain_[c], state);
    state.driving_energy[c] = history ? std::max(psi, start.driving_energy[c]) : psi;
    return stiffness_.residual_energy(c, psi, state.damage[c]);
  });
}

// Path-following: displacements at given damage are proportional to the load, so that the load at which the damage
// equation yields the prescribed surface energy is the root of one rising function (dissipation as the control:
// Gutierrez, Commun. Numer. Meth. Engng 20 (2004) 19; for phase fields Singh et al., Finite Elem. Anal. Des. 113
// (2016) 14). Changes the load of the state, its displacement and driving energy, and d. The load is the greatest
// allowed where that dissipates less.
bool Staggered::follow_path(const FractureState& start, const PathLimit& limit, FractureState& state,
                            CellField<double>& d) {
  constexpr double precision = 1e-3;  // of the dissipation
  constexpr std::uintmax_t most_tries = 60;
  const double solved_load = state.load;
  double load = solved_load;
  bool damage_solved = false, reached = false;
  const auto excess = [&](double tried) {
    load = tried;
    drive(start, state, load / solved_load);
    damage_solved = solve_damage(start, state, d);
    const double energy = damage_.fracture_energy(d) - limit.energy;
    reached = std::abs(energy) <= precision * limit.step;
    return reached ? 0.0 : energy;
  };
  double below = load, above = load;
  double at_below = excess(load), at_above = at_below;
  for (double factor = 1.004; at_above < 0.0 && above < limit.load; factor *= factor) {
    below = above, at_below = at_above;
    above = std::min(factor * above, limit.load);
    at_above = excess(above);
  }
  for (double factor = 1.004; at_below > 0.0; factor *= factor) {
    above = below, at_above = at_below;
    below /= factor;
    at_below = excess(below);
  }
  if (at_below < 0.0 && at_above > 0.0) {
    const auto close_enough = [&](double a, double b) { return reached || b - a <= 1e-12 * b; };
    std::uintmax_t tries = most_tries;
    const auto [a, b] =
        boost::math::tools::toms748_solve(excess, below, above, at_below, at_above, close_enough, tries);
    if (!reached) excess(0.5 * (a + b));
  }
  for (Vector& u : state.displacement) u *= load / solved_load;
  state.load = load;
  return damage_solved;
}

ResidualShare Staggered::residual_share(const FractureState& state, const Energies& energies) {
  ResidualShare share{.elastic = energies.stored, .residual = energies.residual};
  if (!holds_all(share.residual, share.elastic)) return share;
  const std::vector<Vector> force = momentum_.balance().boundary_forces(state.displacement);
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k)
    if (const Index f = unknowns_.face_of_node[k]; !mesh_.is_interior(f))
      share.traction_work += force[as_size(f - mesh_.n_interior_faces())].dot(
          unknowns_.free_directions[k] * state.displacement[as_size(unknowns_.n_cells) + k]);
  return share;
}

bool Staggered::solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d) {
  const auto lap = clock_.lap("damage");
  const bool bounds = model_.irreversibility == Irreversibility::bounds;
  const CellField<double> zero(bounds ? 0 : as_size(mesh_.n_cells()), 0.0);
  return damage_.solve(state.driving_energy, bounds ? start.damage : zero, {.reduction = 1e-3}, d).converged;
}

}  // namespace pfdm
