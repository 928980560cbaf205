#include "solver/fracture/staggered.h"

#include "solver/fracture/equilibrium/finite_newton.h"
#include "solver/fracture/equilibrium/law_newton.h"
#include "solver/momentum/solution/force_balance.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

// Largest numbers of FGMRES iterations of the last solve, and of Newton's steps at finite strain.
constexpr Index last_iterations = 400, last_steps = 30;
// Relative residual of the last solve, if no smaller one is required.
constexpr double last_tolerance = 1e-8;

}  // namespace

Staggered::Staggered(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns,
                     const StaggeredSettings& settings)
    : mesh_(mesh),
      model_(model),
      unknowns_(unknowns),
      given_tolerance_(settings.equilibrium_tolerance),
      settings_(settings),
      momentum_(mesh, unknowns, settings.linear),
      stiffness_(make_cell_stiffness(mesh, model)),
      strength_(make_body_strength(mesh, model, *stiffness_)),
      temperature_(mesh, model),
      faces_(mesh, model, unknowns),
      damage_(mesh, model, unknowns.plane_normal),
      fatigue_(make_body_fatigue(mesh, model)),
      way_(stiffness_->descends() ? Relaxation::Way::momentum : Relaxation::Way::secant),
      has_newton_(way_ == Relaxation::Way::momentum && !stiffness_->depends_on_strain() && !faces_.any() &&
                  !model.has_eigenstrain() && CoupledNewton::suits(mesh, unknowns)) {
  stiffness_->prepare(momentum_);
}

StepOutcome Staggered::solve_step(const FractureState& start, FractureState& state, const StepLimits& limits,
                                  const IterationWatch& watch) {
  tightening_ = state.balance.tightening;
  settings_.equilibrium_tolerance = tightening_ * given_tolerance_;
  stiffness_->start_step(limits.duration, temperature_.factors(start, state.load));
  faces_.start_step(limits.duration);
  telling_ = {.watch = watch, .last = {.step = state.step, .load = state.load}, .after = telling_.after};
  momentum_.start_afresh();  // as a restarted run does
  stiffness_->start_from(start, 0.0);
  fatigue_->set_toughness(start, damage_);
  strength_->begin(start, [&] { return strength_seen(start); });
  const FreeStrained strained_before = free_strained(start);
  stiffness_->start_from(start, limits.duration);
  stiffness_->hold(state);
  StepOutcome outcome = alternate(start, state, limits);
  if (outcome.failed || outcome.broke_too_much || outcome.collapsed) return outcome;
  // Reactions balance, and energies belong to the damage of the step.
  degrade(state);
  const Equilibrium equilibrium = balance_exactly(start, tightening_, state);
  outcome.krylov_iterations += equilibrium.iterations;
  outcome.residual = equilibrium.residual;
  outcome.converged = outcome.converged && equilibrium.residual <= settings_.equilibrium_tolerance;
  const Energies energies = update_driving_energy(start, state, false);
  outcome.energy.elastic = energies.stored - energies.interfaces;
  outcome.energy.interface_energy = energies.interfaces;
  outcome.energy.interface_dissipation = faces_.dissipated(start.interfaces, state.interfaces);
  outcome.energy.interface_viscous_dissipation = faces_.viscous_dissipation(start.interfaces, state.interfaces);
  outcome.share = residual_share(state, energies);
  outcome.collapsed = outcome.converged && has_collapsed(outcome.share);
  outcome.energy.viscous_dissipation = damage_.viscous_dissipation(state.damage);
  outcome.energy.strength_dissipation = strength_->dissipation(start.damage, state.damage);
  outcome.energy.plastic_dissipation = stiffness_->plastic_dissipation(start, state);
  outcome.energy.eigenstrain_work = eigenstrain_work(strained_before, free_strained(state));
  fatigue_->end_step(of_cells_.driving, damage_, state);
  outcome.balance = outcome.converged ? tightened(start, state, energies.force) : state.balance;
  return outcome;
}

Equilibrium Staggered::balance_exactly(const FractureState& start, double tightening, FractureState& state) {
  const double tolerance = tightening * std::min(last_tolerance, given_tolerance_);
  return solve_momentum(start, state,
                        {.reduction = 0.0,
                         .ceiling = tolerance,
                         .floor = tolerance,
                         .most_iterations = last_iterations,
                         .good_enough = tightening * given_tolerance_},
                        last_steps);
}

ForceBalance Staggered::tightened(const FractureState& start, const FractureState& state, double force) {
  constexpr double is_less = 0.5;
  ForceBalance balance = state.balance;
  const double before = balance.greatest_force;
  balance.greatest_force = std::max(before, force);
  if (balance.is_tightest) return balance;
  // Where no force acts but what is left is one, it falls with the rest.
  const auto imbalance = [&](const FractureState& at, double through) {
    return unbalanced_force(momentum_, at.load, at.displacement) / std::max({before, through, 1e-300});
  };
  const auto stresses = [&](const FractureState& at) {
    return momentum_.balance().mechanics(at.displacement, MomentumOperator::Wanted::without_gradient).stress;
  };
  const double least = least_tolerance / std::min(last_tolerance, given_tolerance_);
  double tightening = balance.tightening;
  FractureState tried{};
  for (double share = imbalance(state, force); share > bearable_imbalance && !balance.is_tightest;) {
    if (tried.displacement.empty()) tried = state;
    tightening = std::max(least, needed_tightening(share) * tightening);
    balance_exactly(start, tightening, tried);
    const CellField<Tensor> stress = stresses(tried);
    const double through = force_through(mesh_, momentum_.balance().boundary_forces(tried.displacement), stress);
    const double left = imbalance(tried, through);
    const bool helps = left < is_less * share, falls = std::max(before, through) < is_less * force;
    if (!helps && falls && !any_stress_stays(stresses(state), stress)) {
      balance = state.balance;
      break;
    }
    if (helps || falls) balance.tightening = tightening;
    balance.is_tightest = tightening == least || !(helps || falls);
    share = left;
    force = through;
  }
  if (!tried.displacement.empty()) degrade(state);  // it stays accepted where nothing helped
  return balance;
}

void Staggered::jump(double cycles, FractureState& state) { fatigue_->jump(cycles, damage_, state); }

double Staggered::surface_energy(const FractureState& state) {
  fatigue_->set_toughness(state, damage_);
  return damage_.fracture_energy(state.damage) + fatigue_->spent_energy(state.fatigue);
}

double Staggered::renewed_surface_energy(const FractureState& state) {
  fatigue_->set_toughness(state, damage_);
  return damage_.renewed_fracture_energy(state.damage) + fatigue_->spent_energy(state.fatigue);
}

CellField<double> Staggered::surface_energy_density(const FractureState& state) {
  fatigue_->set_toughness(state, damage_);
  CellField<double> density = damage_.fracture_energy_density(state.damage);
  fatigue_->add_spent(state.fatigue, density);
  return density;
}

bool Staggered::has_reduced_energy() const {
  return !faces_.any() && !model_.is_finite_strain() && !stiffness_->has_histories() && !model_.has_strength() &&
         !(model_.viscosity > 0.0) && !model_.motion.any() && model_.irreversibility != Irreversibility::history;
}

double Staggered::reduced_energy(FractureState state) {
  degrade(state);
  const double tolerance = tightening_ * last_tolerance;
  momentum_.solve(state.load, {.reduction = 0.0, .ceiling = tolerance, .floor = tolerance}, state.displacement);
  const CellMechanics mechanics = momentum_.balance().mechanics(
      state.displacement, MomentumOperator::Wanted::without_gradient, stiffness_->degradable_part(state));
  double energy = damage_.renewed_fracture_energy(state.damage);
  energy += parallel_sum(mesh_.n_cells(), [&](Index c) { return stiffness_->stored_energy(c, mechanics, state); });
  return energy + potential_of_loads(balance(), state);
}

FreeStrained Staggered::free_strained(const FractureState& state) {
  if (!model_.has_eigenstrain()) return {};
  degrade(state);
  CellMechanics mechanics =
      momentum_.balance().mechanics(state.displacement, MomentumOperator::Wanted::without_gradient);
  return {stiffness_->eigenstrain_moments(mechanics, state, unknowns_.plane_normal), std::move(mechanics.eigenstrain)};
}

void Staggered::hold(const FractureState& state) {
  stiffness_->start_from(state, 0.0);
  degrade(state);
}

void Staggered::degrade(const FractureState& state) {
  const auto lap = clock_.lap("moduli_and_preconditioner");
  if (damage_.stiffness_damage().any()) stiffness_->see(damage_.stiffness_damage().of(state.damage));
  stiffness_->set(state, momentum_);
}

Equilibrium Staggered::solve_momentum(const FractureState& start, FractureState& state,
                                      const MomentumSolver::Tolerance& tolerance, Index most_newton_steps) {
  const auto lap = clock_.lap("momentum");
  if (faces_.any()) {
    const CellLaws cells = stiffness_->is_linearised() ? [&] { stiffness_->set(state, momentum_); } : CellLaws();
    return solve_with_faces(faces_, start.interfaces, state.load, tolerance, cells, momentum_, state.displacement,
                            state.interfaces, watch_of_balance(state));
  }
  switch (stiffness_->balance_is()) {
    case BalanceIs::finite: return solve_finite(*stiffness_, tolerance, momentum_, state, most_newton_steps);
    case BalanceIs::convex: return solve_with_laws(*stiffness_, tolerance, momentum_, state);
    case BalanceIs::linear: break;
  }
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
      state.displacement, MomentumOperator::Wanted::without_gradient, stiffness_->degradable_part(state));
  Energies energies{.unsettled = stiffness_->integrate(mechanics, start, state)};
  of_cells_ = stiffness_->energies(mechanics, state);
  if (!settles) energies.force = force_through(mesh_, balance().boundary_forces(state.displacement), mechanics.stress);
  energies.stored = parallel_sum(mesh_.n_cells(), [&](Index c) { return of_cells_.stored[c]; });
  energies.interfaces = faces_.advance(momentum_.balance(), state.displacement, start.interfaces, state.interfaces);
  energies.stored += energies.interfaces;
  energies.torn = faces_.dissipated(faces_.virgin_histories(), state.interfaces);
  strength_->see(mechanics, state, of_cells_.driving);
  energies.residual = drive(start, state, 1.0);
  if (settles) energies.unsettled += stiffness_->follow(mechanics, state);
  return energies;
}

BodyStrength::Seen Staggered::strength_seen(const FractureState& state) {
  degrade(state);
  CellMechanics mechanics = momentum_.balance().mechanics(
      state.displacement, MomentumOperator::Wanted::without_gradient, stiffness_->degradable_part(state));
  CellField<double> psi_plus = stiffness_->energies(mechanics, state).driving;
  return {std::move(mechanics), std::move(psi_plus)};
}

// The driving energy of the last equilibrium with its displacements times `scale`. Returns what the residual stiffness
// stores [J].
double Staggered::drive(const FractureState& start, FractureState& state, double scale) {
  const bool history = model_.irreversibility == Irreversibility::history;
  strength_->give(scale, [this](CellField<double> force) { damage_.set_driving_force(std::move(force)); });
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    const double psi = scale * scale * of_cells_.driving[c];
    const double opening = strength_->opening(c, psi, scale);
    state.driving_energy[c] = history ? std::max(opening, start.driving_energy[c]) : opening;
    return stiffness_->residual_energy(c, psi, of_cells_.idle[c], state);
  });
}

ResidualShare Staggered::residual_share(const FractureState& state, const Energies& energies) const {
  ResidualShare share{.elastic = energies.stored, .residual = energies.residual};
  if (holds_all(share.residual, share.elastic))
    share.traction_work = work_of_free_loads(momentum_.balance(), unknowns_, state);
  return share;
}

bool Staggered::solve_damage(const FractureState& start, const FractureState& state, CellField<double>& d) {
  const auto lap = clock_.lap("damage");
  const CellField<double> lower = model_.lower_bound(start.damage);
  const ScalarTolerance tolerance{.reduction = 1e-3};
  if (!of_cells_.law || model_.irreversibility == Irreversibility::history)
    return damage_.solve(state.driving_energy, lower, tolerance, d).converged;
  const DrivingLaw law = [&](Index c, double at) {
    return strength_->is_closed(c) ? DrivingAt{} : of_cells_.law(c, at);
  };
  return damage_.solve(law, lower, tolerance, d).converged;
}

}  // namespace pfdm
