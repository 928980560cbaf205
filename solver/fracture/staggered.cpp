#include "solver/fracture/staggered.h"

#include "solver/fracture/equilibrium/finite_newton.h"
#include "solver/fracture/equilibrium/law_newton.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

// Largest numbers of FGMRES iterations, within the loop and of the last solve.
constexpr Index inner_iterations = 80, last_iterations = 400;
constexpr Index stuck_at_most = 20;
// Likewise of Newton's steps at finite strain.
constexpr Index inner_steps = 6, last_steps = 30;
// Successive iterations in which only the residual stiffness may carry the loads: the first ones are inexact.
constexpr Index torn_at_most = 5;
// Relative residual of the last solve, if no smaller one is required.
constexpr double last_tolerance = 1e-8;

}  // namespace

Staggered::Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                     const StaggeredSettings& settings)
    : mesh_(mesh),
      model_(model),
      unknowns_(unknowns),
      settings_(settings),
      momentum_(mesh, unknowns, settings.linear),
      stiffness_(mesh, model),
      faces_(mesh, model, unknowns),
      damage_(mesh, model, unknowns.plane_normal),
      way_(stiffness_.descends() ? Relaxation::Way::momentum : Relaxation::Way::secant),
      has_newton_(way_ == Relaxation::Way::momentum && !stiffness_.depends_on_strain() && !faces_.any() &&
                  !model.has_eigenstrain() && CoupledNewton::suits(mesh, unknowns)),
      psi_plus_(as_size(mesh.n_cells())) {}

StepOutcome Staggered::solve_step(const FractureState& start, FractureState& state, const StepLimits& limits,
                                  const IterationWatch& watch) {
  stiffness_.start_step(limits.duration);
  momentum_.start_afresh();  // as a restarted run does
  const StrengthDrive strength_before = strength_drive_of(start);
  const FreeStrained strained_before = free_strained(start);
  StepOutcome outcome = alternate(start, state, limits, watch);
  if (outcome.failed || outcome.broke_too_much || outcome.collapsed) return outcome;
  // Reactions balance, and energies belong to the damage of the step.
  degrade(state);
  const double tolerance = std::min(last_tolerance, settings_.equilibrium_tolerance);
  const Equilibrium equilibrium = solve_momentum(start, state,
                                                 {.reduction = 0.0,
                                                  .ceiling = tolerance,
                                                  .floor = tolerance,
                                                  .most_iterations = last_iterations,
                                                  .good_enough = settings_.equilibrium_tolerance},
                                                 last_steps);
  outcome.krylov_iterations += equilibrium.iterations;
  outcome.residual = equilibrium.residual;
  outcome.converged = outcome.converged && equilibrium.residual <= settings_.equilibrium_tolerance;
  const Energies energies = update_driving_energy(start, state, false);
  outcome.energy.elastic = energies.stored - energies.interfaces;
  outcome.energy.interface_energy = energies.interfaces;
  outcome.energy.interface_dissipation = faces_.dissipated(start.interfaces, state.interfaces);
  outcome.share = residual_share(state, energies);
  outcome.collapsed = outcome.converged && has_collapsed(outcome.share);
  outcome.energy.viscous_dissipation = damage_.viscous_dissipation(state.damage);
  outcome.energy.strength_dissipation =
      strength_dissipation(mesh_, model_, strength_before, strength_, start.damage, state.damage);
  outcome.energy.plastic_dissipation = stiffness_.plastic_dissipation(start, state);
  outcome.energy.eigenstrain_work = eigenstrain_work(strained_before, free_strained(state));
  return outcome;
}

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
      newton.emplace(s.mesh_, s.model_, s.stiffness_.degradable_part(state), s.momentum_, s.damage_);
    if (s.model_.viscosity > 0.0) s.damage_.resist_change(s.model_.viscosity / limits.duration, start.damage);
  }

  // With cohesive faces nothing else dissipates: Newton's method finds the load.
  bool follows_faces() const { return s.faces_.any() && std::isfinite(limits.dissipation); }
  bool follows_path() const { return !s.faces_.any() && std::isfinite(limits.dissipation); }
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
                                              .ceiling = outcome.settled ? required : 1e-4,
                                              .floor = 0.1 * required,
                                              .most_iterations = inner_iterations};
    Equilibrium equilibrium = follows_faces() ? s.follow_faces(start, faces_path, tolerance, state)
                                              : s.solve_momentum(start, state, tolerance, inner_steps);
    if (s.stiffness_.finite().any()) equilibrium = approach(tolerance, equilibrium);
    const bool halves = equilibrium.residual <= 0.5 * equilibrium.initial_residual;
    stuck = halves || equilibrium.iterations < inner_iterations ? 0 : stuck + 1;
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
    const bool finite = s.stiffness_.finite().any();
    if (s.faces_.any() && finite && !(start.load > 0.0)) return energies.stored + energies.torn - torn_before;
    if (!s.faces_.any() || !(start.load > 0.0)) return energies.stored;
    const double growth = state.load / start.load, stored = start.energy.elastic + start.energy.interface_energy;
    if (!finite) return growth * growth * stored;
    const double work =
        s.work(start, state.load, s.momentum_.balance().boundary_forces(state.displacement), state.displacement);
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
    const double energy_change = (std::abs(energy - energy_before) + energies.unsettled) / std::max(energy, 1e-300);
    energy_before = energy;
    ++outcome.iterations;
    outcome.rest = {restless, change, energy_change};
    outcome.settled = solved && damage_is_settled && energy_change < s.settings_.energy_tolerance &&
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
    report = {state.step, outcome.iterations, state.load, change, energy_change, report.krylov_iterations};
  }
};

// The next damage; Newton's method changes the displacement as well.
CoupledNewton::Moved Staggered::Loop::advance(CellField<double>& answer) {
  auto moved = CoupledNewton::Moved::no;
  if (newton) {
    const auto lap = s.clock_.lap("coupled_newton");
    const double energy = energies.stored + s.damage_.fracture_energy(state.damage) + s.potential_of_loads(state);
    moved = newton->move({energy, lower}, state, answer);
    report.krylov_iterations += newton->krylov_iterations();
  }
  if (moved == CoupledNewton::Moved::on)
    relaxation.lose_momentum();
  else
    state.damage = relaxation.next(state.damage, answer, lower);
  return moved;
}

StepOutcome Staggered::alternate(const FractureState& start, FractureState& state, const StepLimits& limits,
                                 const IterationWatch& watch) {
  Loop loop(*this, start, state, limits);
  while (!loop.ends()) {
    const Index iterations = loop.outcome.iterations;
    loop.iterate();
    if (watch && loop.outcome.iterations > iterations) watch(loop.report);
  }
  loop.outcome.circles = !loop.outcome.converged && loop.relaxation.goes_in_circles();
  return loop.outcome;
}

bool Staggered::has_reduced_energy() const {
  return !faces_.any() && !model_.has_eigenstrain() && !stiffness_.finite().any() && !stiffness_.materials().any() &&
         !model_.has_strength() && !(model_.viscosity > 0.0) && !model_.motion.any() &&
         model_.irreversibility != Irreversibility::history;
}

double Staggered::reduced_energy(FractureState state) {
  degrade(state);
  momentum_.solve(state.load, {.reduction = 0.0, .ceiling = last_tolerance, .floor = last_tolerance},
                  state.displacement);
  const CellMechanics mechanics = momentum_.balance().mechanics(
      state.displacement, MomentumOperator::Wanted::without_gradient, stiffness_.degradable_part(state));
  double energy = damage_.renewed_fracture_energy(state.damage);
  energy += parallel_sum(mesh_.n_cells(), [&](Index c) { return stiffness_.stored_energy(c, mechanics, state); });
  return energy + potential_of_loads(state);
}

double Staggered::potential_of_loads(const FractureState& state) const {
  const std::vector<Vector> load = momentum_.balance().load_vector(state.load);
  double potential = momentum_.balance().foundation_energy(state.displacement);
  for (std::size_t i = 0; i < load.size(); ++i) potential -= load[i].dot(state.displacement[i]);
  return potential;
}

double Staggered::work(const FractureState& from, double t, const std::vector<Vector>& force,
                       const std::vector<Vector>& displacement) const {
  double work = 0.0;
  for (Index f = mesh_.n_interior_faces(); f < mesh_.n_faces(); ++f) {
    const Index node = unknowns_.node_of_face[f];
    if (node < 0) continue;
    const auto k = as_size(f - mesh_.n_interior_faces());
    work +=
        0.5 * (from.boundary_force[k] + force[k]).dot(displacement[as_size(node)] - from.displacement[as_size(node)]);
  }
  if (const auto& body = unknowns_.loads.force)
    work += parallel_sum(mesh_.n_cells(), [&](Index c) {
      const Vector before = from.step > 0 ? body(mesh_, c, from.load) : Vector::Zero();
      const Vector moved = displacement[as_size(c)] - from.displacement[as_size(c)];
      return 0.5 * mesh_.cell_volume[c] * (before + body(mesh_, c, t)).dot(moved);
    });
  return work;
}

Staggered::FreeStrained Staggered::free_strained(const FractureState& state) {
  if (!model_.has_eigenstrain()) return {};
  degrade(state);
  CellMechanics mechanics =
      momentum_.balance().mechanics(state.displacement, MomentumOperator::Wanted::without_gradient);
  return {stiffness_.eigenstrain_moments(mechanics, state, unknowns_.plane_normal), std::move(mechanics.eigenstrain)};
}

double Staggered::eigenstrain_work(const FreeStrained& from, const FreeStrained& to) const {
  return parallel_sum(to.eigenstrain.size(), [&](Index c) {
    if (from.eigenstrain.size() == 0) return -0.5 * to.moment[c].dot(to.eigenstrain[c]);
    const Mandel grown = to.eigenstrain[c] - from.eigenstrain[c];
    return -0.5 * (from.moment[c] + to.moment[c]).dot(grown);
  });
}

void Staggered::degrade(const FractureState& state) {
  const auto lap = clock_.lap("moduli_and_preconditioner");
  if (damage_.stiffness_damage().any()) stiffness_.see(damage_.stiffness_damage().of(state.damage));
  stiffness_.set(state, momentum_);
}

Equilibrium Staggered::solve_momentum(const FractureState& start, FractureState& state,
                                      const MomentumSolver::Tolerance& tolerance, Index most_newton_steps) {
  const auto lap = clock_.lap("momentum");
  if (faces_.any()) {
    const CellLaws cells = stiffness_.is_linearised() ? [&] { stiffness_.set(state, momentum_); } : CellLaws();
    return solve_with_faces(faces_, start.interfaces, state.load, tolerance, cells, momentum_, state.displacement);
  }
  if (stiffness_.finite().any()) return solve_finite(stiffness_, tolerance, momentum_, state, most_newton_steps);
  if (stiffness_.is_linearised()) return solve_with_laws(stiffness_, tolerance, momentum_, state);
  return momentum_.solve(state.load, tolerance, state.displacement);
}

Equilibrium Staggered::follow_faces(const FractureState& start, const FacesPath& path,
                                    const MomentumSolver::Tolerance& tolerance, FractureState& state) {
  const auto lap = clock_.lap("momentum");
  return follow_with_faces(faces_, start.interfaces, path, tolerance, momentum_, state.load, state.displacement);
}

Staggered::Energies Staggered::update_driving_energy(const FractureState& start, FractureState& state, bool settles) {
  const auto lap = clock_.lap("driving_energy");
  CellMechanics mechanics = momentum_.balance().mechanics(
      state.displacement, MomentumOperator::Wanted::without_gradient, stiffness_.degradable_part(state));
  Energies energies{.unsettled = stiffness_.integrate(mechanics, start, state)};
  find_driving_energy(mechanics, state);
  energies.stored = parallel_sum(mesh_.n_cells(), [&](Index c) {
    return finite_.size() > 0 ? stiffness_.stored_energy(c, finite_[c], state.damage[c])
                              : stiffness_.stored_energy(c, mechanics, state);
  });
  energies.interfaces = faces_.advance(momentum_.balance(), state.displacement, start.interfaces, state.interfaces);
  energies.stored += energies.interfaces;
  energies.torn = faces_.dissipated(faces_.virgin_histories(), state.interfaces);
  strength_ = strength_drive(mesh_, model_, stiffness_, mechanics, state, psi_plus_);
  energies.residual = drive(start, state, 1.0);
  if (settles) energies.unsettled += stiffness_.follow(mechanics, state);
  return energies;
}

void Staggered::find_driving_energy(const CellMechanics& mechanics, const FractureState& state) {
  if (stiffness_.finite().any()) finite_ = stiffness_.finite_energies(mechanics, state);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    psi_plus_[c] = finite_.size() > 0 ? stiffness_.driving_energy(c, finite_[c], state.damage[c]).value
                                      : stiffness_.driving_energy(c, mechanics, state);
  });
}

StrengthDrive Staggered::strength_drive_of(const FractureState& state) {
  if (!model_.has_strength()) return {};
  degrade(state);
  const CellMechanics mechanics = momentum_.balance().mechanics(
      state.displacement, MomentumOperator::Wanted::without_gradient, stiffness_.degradable_part(state));
  find_driving_energy(mechanics, state);
  return strength_drive(mesh_, model_, stiffness_, mechanics, state, psi_plus_);
}

// The driving energy of the last equilibrium with its displacements times `scale`. Returns what the residual stiffness
// stores [J].
double Staggered::drive(const FractureState& start, FractureState& state, double scale) {
  const bool history = model_.irreversibility == Irreversibility::history;
  if (strength_.force.size() > 0) {
    CellField<double> force(as_size(mesh_.n_cells()));
    parallel_for(mesh_.n_cells(), [&](Index c) { force[c] = scale * strength_.force[c]; });
    damage_.set_driving_force(std::move(force));
  }
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    const double psi = scale * scale * psi_plus_[c];
    const double opening = strength_.closed.size() > 0 ? psi - scale * scale * strength_.closed[c] : psi;
    state.driving_energy[c] = history ? std::max(opening, start.driving_energy[c]) : opening;
    return stiffness_.residual_energy(c, psi, state);
  });
}

ResidualShare Staggered::residual_share(const FractureState& state, const Energies& energies) {
  ResidualShare share{.elastic = energies.stored, .residual = energies.residual};
  if (!holds_all(share.residual, share.elastic)) return share;
  const std::vector<Vector> force = momentum_.balance().traction_forces(state.load);
  // A part that prescribed displacements move, or hold, bears its body forces there. One that falls moves much farther.
  constexpr double falls = 3.0;
  double prescribed = 0.0;
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k) {
    const Vector& u = state.displacement[as_size(unknowns_.n_cells) + k];
    prescribed = std::max(prescribed, (u - unknowns_.free_directions[k] * u).norm());
  }
  for (std::size_t i = 0; i < force.size(); ++i) {
    const bool is_body_force = i < as_size(unknowns_.n_cells);
    if (is_body_force && state.displacement[i].norm() <= falls * prescribed) continue;
    share.traction_work += force[i].dot(state.displacement[i]);
  }
  return share;
}

bool Staggered::solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d) {
  const auto lap = clock_.lap("damage");
  const CellField<double> lower = model_.lower_bound(start.damage);
  const ScalarTolerance tolerance{.reduction = 1e-3};
  if (finite_.size() == 0 || model_.irreversibility == Irreversibility::history)
    return damage_.solve(state.driving_energy, lower, tolerance, d).converged;
  const DrivingLaw law = [&](Index c, double at) {
    const bool is_closed = strength_.closed.size() > 0 && strength_.closed[c] > 0.0;
    return is_closed ? DrivingAt{} : stiffness_.driving_energy(c, finite_[c], at);
  };
  return damage_.solve(law, lower, tolerance, d).converged;
}

}  // namespace pfdm
