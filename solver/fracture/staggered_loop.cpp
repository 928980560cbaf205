// The loop of alternate minimisation: equilibrium, driving energy, damage.

#include "solver/fracture/staggered.h"

#include "solver/fracture/unconverged.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

// Largest numbers of FGMRES iterations, and of Newton's steps at finite strain.
constexpr Index inner_steps = 6;
constexpr Index stuck_at_most = 20;
// Successive iterations in which only the residual stiffness may carry the loads: the first ones are inexact.
constexpr Index torn_at_most = 5;

}  // namespace

/// The loop of one step.
struct Staggered::Loop {
  Staggered& s;
  const FractureState& start;
  FractureState& state;
  const StepLimits& limits;
  const CellField<double> lower;  // bound of the damage
  double fracture_energy;         // at the start [J]
  double torn_before;             // dissipated by cohesive faces until then [J]
  PathLimit path{};
  FacesPath faces_path{};
  Relaxation relaxation{s.way_};
  std::optional<CoupledNewton> newton{};
  Energies energies{};                      // of the last equilibrium
  CellField<double> last_damage{};          // at finite strain, likewise
  std::vector<Vector> last_displacement{};  // and
  double stored_at_unit_load = 0.0, energy_before = 0.0;
  Index torn = 0;   // successive iterations in which only the residual stiffness carried the loads
  Index stuck = 0;  // in which the linear solver did not halve the residual
  StepOutcome outcome{};
  IterationReport report{};

  Loop(Staggered& staggered, const FractureState& first, FractureState& trial, const StepLimits& step_limits)
      : s(staggered),
        start(first),
        state(trial),
        limits(step_limits),
        lower(s.model_.irreversibility == Irreversibility::history ? first.damage : s.model_.lower_bound(first.damage)),
        fracture_energy(s.damage_.renewed_fracture_energy(first.damage)),
        torn_before(s.faces_.dissipated(s.faces_.virgin_histories(), first.interfaces)) {
    if (follows_path()) path = {state.load, fracture_energy + limits.dissipation, limits.dissipation};
    faces_path = {.most_load = state.load, .dissipation = limits.dissipation};
    if (follows_faces() && start.load > 0.0) state.load = start.load;
    if (s.has_newton_ && !follows_path() && !(s.model_.viscosity > 0.0))
      newton.emplace(s.mesh_, s.model_, s.stiffness_->degradable_part(state), s.momentum_, s.damage_);
    if (s.model_.viscosity > 0.0) s.damage_.resist_change(s.model_.viscosity / limits.duration, start.damage);
  }

  // With cohesive faces nothing else dissipates: Newton's method finds the load.
  bool follows_faces() const { return s.faces_.any() && std::isfinite(limits.dissipation); }
  bool follows_path() const { return !s.faces_.any() && std::isfinite(limits.dissipation); }
  // Where a pressure is not found, cracks open and close at random from one iteration to the next.
  Index inner_iterations() const { return s.unknowns_.pressure_cells.empty() ? 80 : 240; }
  bool ends() const {
    return outcome.converged || outcome.failed || outcome.collapsed || outcome.broke_too_much ||
           outcome.iterations >= s.settings_.maximum_iterations || (limits.may_be_cut && relaxation.goes_in_circles());
  }

  void iterate() {
    find_equilibrium();
    if (!outcome.failed) renew_driving_energy();
    if (!outcome.failed && !outcome.collapsed) renew_damage();
  }

  void find_equilibrium() {
    s.degrade(state);
    // Loose while the damage still changes; as tight as the step requires once it has converged.
    const double required = s.settings_.equilibrium_tolerance;
    // A crack that is closed and sheared is nearly incompressible and takes many Krylov iterations: the remaining
    // residual is left to the next iteration of the loop.
    const MomentumSolver::Tolerance tolerance{.reduction = 0.1,
                                              .ceiling = outcome.settled ? required : 1e-4 * s.tightening_,
                                              .floor = 0.1 * required,
                                              .most_iterations = inner_iterations()};
    Equilibrium equilibrium = follows_faces() ? s.follow_faces(start, faces_path, tolerance, state)
                                              : s.solve_momentum(start, state, tolerance, inner_steps);
    if (s.model_.is_finite_strain()) equilibrium = approach(tolerance, equilibrium);
    const bool halves = equilibrium.residual <= 0.5 * equilibrium.initial_residual;
    stuck = halves || equilibrium.iterations < tolerance.most_iterations ? 0 : stuck + 1;
    outcome.stuck = stuck > stuck_at_most;
    outcome.failed = !std::isfinite(equilibrium.residual) || outcome.stuck;
    outcome.residual = equilibrium.residual;
    report.krylov_iterations = equilibrium.iterations;
  }

  // At finite strain Newton's method may not bridge all of what the damage has changed by since the last equilibrium:
  // half of it then, and so on. The iteration goes on from there.
  Equilibrium approach(const MomentumSolver::Tolerance& tolerance, Equilibrium equilibrium) {
    constexpr Index most_halvings = 6;
    constexpr double astray = 1.0;  // residual to which a line search by the work along the step may lead
    const auto is_lost = [](const Equilibrium& at) { return !(at.residual <= astray); };
    for (Index k = 0; k < most_halvings && is_lost(equilibrium) && last_damage.size() > 0; ++k) {
      state.displacement = last_displacement;
      for (Index c = 0; c < last_damage.size(); ++c) state.damage[c] = 0.5 * (last_damage[c] + state.damage[c]);
      relaxation.lose_momentum();
      s.degrade(state);
      equilibrium = s.solve_momentum(start, state, tolerance, inner_steps);
    }
    last_damage = state.damage;
    last_displacement = state.displacement;
    return equilibrium;
  }

  void renew_driving_energy() {
    energies = s.update_driving_energy(start, state, true);
    outcome.failed = !std::isfinite(energies.unsettled);
    if (outcome.failed) return;
    if (outcome.iterations == 0) stored_at_unit_load = stored_before() / (state.load * state.load);
    torn = has_collapsed(s.residual_share(state, energies)) ? torn + 1 : 0;
    outcome.collapsed = torn > torn_at_most;
    outcome.starting_energy = stored_at_unit_load * state.load * state.load;
    outcome.energy_release = std::abs(energies.stored - outcome.starting_energy) /
                             std::max(outcome.starting_energy + fracture_energy + torn_before, 1e-300);
  }

  // Cohesive faces have released energy already when the first equilibrium is found: what they and the body had before
  // grows with the load squared. At finite strain it does not: there the work that is not stored, times the growth of
  // the load, is what was released. Of a linear body, whose displacements or tractions grow with the load, it is the
  // same; of others that release nothing the trapezoid of a curved force errs in the third order of the increment only.
  double stored_before() const {
    const bool finite = s.model_.is_finite_strain();
    if (s.faces_.any() && finite && !(start.load > 0.0)) return energies.stored + energies.torn - torn_before;
    if (!s.faces_.any() || !(start.load > 0.0)) return energies.stored;
    const double growth = state.load / start.load, stored = start.energy.stored();
    if (!finite) return growth * growth * stored;
    const double work =
        s.work(start, {state.load, s.balance().boundary_forces(state.displacement), state.displacement});
    return energies.stored + growth * (stored + work - energies.stored);
  }

  CoupledNewton::Moved advance(CellField<double>& answer);

  // The cell whose damage changes most, and by how much.
  std::pair<Index, double> largest_change(const CellField<double>& answer) const {
    const auto change_of = [&](Index c) { return std::abs(answer[c] - state.damage[c]); };
    const double change = parallel_max(answer.size(), change_of);
    Index cell = 0;
    while (cell + 1 < answer.size() && change_of(cell) < change) ++cell;
    return {cell, change};
  }

  // The L2 norm of what the damage changes by, over that of the damage.
  double mean_change(const CellField<double>& answer) const {
    const auto square = [&](const auto& value) {
      return parallel_sum(answer.size(), [&](Index c) { return s.mesh_.cell_volume[c] * value(c) * value(c); });
    };
    const double change = square([&](Index c) { return answer[c] - state.damage[c]; });
    return std::sqrt(change / std::max(square([&](Index c) { return answer[c]; }), 1e-300));
  }

  // What the stiffness errs by, over what the body stores: its cracks may have taken far more. A body that is unloaded
  // stores nothing; one that eigenstrains bend freely may seem to store less than that.
  double unsettled_share(double energy) const {
    constexpr double rounding = 1e-20;
    return energies.unsettled /
           std::max({std::abs(energies.stored), start.energy.stored(), rounding * std::abs(energy), 1e-300});
  }

  void renew_damage() {
    CellField<double> answer = state.damage;
    const double load = state.load;
    const bool solved =
        follows_path() ? s.follow_path(start, path, state, answer) : s.solve_damage(start, state, answer);
    const double load_scale = state.load / load;
    const auto [restless, change] = largest_change(answer);
    const bool damage_is_settled =
        change < s.settings_.damage_tolerance ||
        (s.settings_.damage_tolerance_l2 > 0.0 && mean_change(answer) < s.settings_.damage_tolerance_l2);
    const double energy = load_scale * load_scale * energies.stored + s.damage_.fracture_energy(answer) + energies.torn;
    const double energy_change = std::abs(energy - energy_before) / std::max(std::abs(energy), 1e-300);
    energy_before = energy;
    ++outcome.iterations;
    outcome.rest = {restless, change, energy_change, unsettled_share(energy), s.stiffness_->moving_cracks()};
    outcome.settled = solved && damage_is_settled && outcome.rest.moving.empty() &&
                      energy_change + outcome.rest.stiffness < s.settings_.energy_tolerance &&
                      std::abs(load_scale - 1.0) < s.settings_.damage_tolerance;
    outcome.converged = outcome.settled && outcome.residual <= s.settings_.equilibrium_tolerance;
    auto moved = CoupledNewton::Moved::no;
    if (outcome.converged)
      state.damage = answer;
    else
      moved = advance(answer);
    outcome.krylov_iterations += report.krylov_iterations;
    if (moved == CoupledNewton::Moved::no) {  // not while a step of Newton's is on trial
      outcome.growth = parallel_max(answer.size(), [&](Index c) { return state.damage[c] - start.damage[c]; });
      outcome.broke_too_much = outcome.growth > limits.growth || outcome.energy_release > limits.energy_release;
    }
    if (outcome.broke_too_much) outcome.converged = false;
    report = {state.step,
              outcome.iterations,
              state.load,
              change,
              energy_change + outcome.rest.stiffness,
              report.krylov_iterations};
  }
};

// The next damage; Newton's method changes the displacement as well.
CoupledNewton::Moved Staggered::Loop::advance(CellField<double>& answer) {
  auto moved = CoupledNewton::Moved::no;
  if (newton) {
    const auto lap = s.clock_.lap("coupled_newton");
    const double energy =
        energies.stored + s.damage_.fracture_energy(state.damage) + potential_of_loads(s.balance(), state);
    moved = newton->move({energy, lower}, state, answer);
    report.krylov_iterations += newton->krylov_iterations();
  }
  if (moved == CoupledNewton::Moved::on)
    relaxation.lose_momentum();
  else
    state.damage = relaxation.next(state.damage, answer, lower);
  return moved;
}

StepOutcome Staggered::alternate(const FractureState& start, FractureState& state, const StepLimits& limits) {
  Loop loop(*this, start, state, limits);
  while (!loop.ends()) {
    const Index iterations = loop.outcome.iterations;
    loop.iterate();
    if (loop.outcome.iterations > iterations)
      tell(loop.report, [&] { return what_changes(mesh_, settings_, loop.outcome); });
  }
  loop.outcome.circles = !loop.outcome.converged && loop.relaxation.goes_in_circles();
  return loop.outcome;
}

void Staggered::tell(IterationReport report, const std::function<std::string()>& words) {
  if (!report.in_balance) telling_.last = report;
  if (!telling_.watch) return;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - telling_.began;
  if (taken.count() >= std::max(settings_.long_step, telling_.after)) {
    telling_.after = 2.0 * taken.count();
    report.remark = long_step_words(report, taken.count(), words());
  }
  telling_.watch(report);
}

BalanceWatch Staggered::watch_of_balance(const FractureState& state) {
  if (!telling_.watch) return {};
  return [&](Index solves, double residual) {
    IterationReport report = telling_.last;
    report.in_balance = true;
    tell(report, [&] { return what_is_unbalanced(mesh_, unknowns_, settings_, momentum_, state, {solves, residual}); });
  };
}

}  // namespace pfdm
