#include "solver/fracture/derivatives/run_derivatives.h"

#include "mesh/geometry.h"
#include "physics/error.h"
#include "solver/fracture/equilibrium/coupled_system.h"
#include "solver/momentum/stiffness_coupling.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double load_step = 1e-5;                                     // relative, of the derivative by the load
constexpr double least_unsolved = 1e-6, reduction_of_solution = 1e-5;  // of the right side, in all and by a solution
constexpr double null_reduction = 1e-3;                                // by an inverse iteration
constexpr int null_iterations = 3;
constexpr double share_by_load = 1e-3;  // of the right side by the load, against which those of no influence are small
constexpr int most_refinements = 6;
constexpr Index most_linear_iterations = 300;

double dot(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  return parallel_sum(count_of(a), [&](Index i) { return a[i].dot(b[i]); });
}

/// In the norm of the diagonal, in which displacements and damage add up.
double scaled_dot(const std::vector<Vector>& a, const std::vector<Vector>& b, const std::vector<double>& scale) {
  return parallel_sum(count_of(a), [&](Index i) { return a[i].dot(b[i]) / (scale[i] * scale[i]); });
}

}  // namespace

/// A model, and what evaluates it.
struct RunDerivatives::Model {
  FractureModel model;
  Unknowns unknowns;
  Staggered staggered;

  Model(const Mesh& mesh, const FractureModel& given, const StaggeredSettings& settings)
      : model(given), unknowns(place_unknowns(mesh, elastic_body(model))), staggered(mesh, model, unknowns, settings) {
    if (model.initial_damage.size() > 0)
      model.initial_damage = staggered.damage_equation().relaxed(model.initial_damage);
  }
};

struct RunDerivatives::Parameter {
  Model shifted;
  double step;
  bool is_load;
  Derivative derivative{};
  Jump jump{};
  std::vector<InterfaceHistory> interfaces, earlier;  // of the shifted model, before the step and the one before it
  std::vector<Vector> right_side{}, earlier_right_side{}, answer{};  // of the last steps

  Parameter(const Mesh& mesh, const FractureModel& model, const StaggeredSettings& settings, double by, bool of_load)
      : shifted(mesh, model, settings),
        step(by),
        is_load(of_load),
        interfaces(shifted.staggered.faces().virgin_histories()),
        earlier(interfaces) {
    derivative.damage = CellField<double>(mesh.n_cells(), 0.0);
  }
};

/// An accepted step.
struct RunDerivatives::Step {
  FractureState state;
  std::vector<InterfaceHistory> before;  // of the cohesive faces
  ConjugateGradients::Held held;         // cells whose damage is on a bound, or cannot grow
  std::vector<char> inherits;            // of these the ones whose damage is that of the step before
};

/// The equations at a state.
struct RunDerivatives::Linearised {
  Unbalanced base;
  std::unique_ptr<CoupledSystem> system;

  /// Difference of the unbalanced forces and damage of another model, over its step.
  std::vector<Vector> difference(const Unbalanced& other, double step) const {
    std::vector<Vector> b(system->size(), Vector::Zero());
    parallel_for(count_of(base.forces), [&](Index i) { b[i] = (other.forces[i] - base.forces[i]) / step; });
    parallel_for(system->n_cells(), [&](Index c) {
      if (!system->is_held(c)) system->of(b, c) = (other.damage[c] - base.damage[c]) / (step * system->root(c));
    });
    return b;
  }
  /// The state moved by an answer.
  void move(const FractureState& from, const std::vector<Vector>& x, double step, FractureState& to) const {
    parallel_for(count_of(from.displacement),
                 [&](Index i) { to.displacement[i] = from.displacement[i] + step * x[i]; });
    parallel_for(system->n_cells(),
                 [&](Index c) { to.damage[c] = from.damage[c] + step * system->of(x, c) / system->root(c); });
  }
};

std::string RunDerivatives::refusal(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading) {
  const auto any = [&](auto asked) { return std::ranges::any_of(model.regions, asked); };
  const auto any_surface = [&](auto asked) { return std::ranges::any_of(model.interfaces, asked); };
  if (model.is_finite_strain()) return "finite strain";
  if (any([](const RegionModel& r) { return r.material != nullptr; })) return "a material with a history";
  if (any([](const RegionModel& r) { return r.fatigue.is_chosen(); })) return "fatigue";
  if (model.has_strength()) return "a model of strength";
  if (model.has_eigenstrain()) return "eigenstrains";
  if (model.heat) return "heat";
  if (model.viscosity > 0.0) return "a viscosity";
  if (model.motion.any()) return "a load by mean strains";
  if (model.irreversibility == Irreversibility::history) return "irreversibility = \"history\"";
  if (model.stiffness_by == StiffnessBy::mean) return "stiffness_damage = \"mean\"";
  if (loading.controls_dissipation()) return "path-following";
  if (any_surface([](const CohesiveSurface& s) { return s.law.rate.any(); })) return "an interface with a rate";
  if (!any([](const RegionModel& r) { return r.damageable; })) return "";
  if (!model.is_isotropic()) return "a split or an elasticity without isotropic moduli where damage may grow";
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  return StiffnessCoupling::covers(mesh, unknowns) ? "" : "polyhedra, pressures or an axis where damage may grow";
}

RunDerivatives::RunDerivatives(const Mesh& mesh, const FractureModel& model, const StaggeredSettings& settings)
    : mesh_(mesh),
      settings_(settings),
      base_(std::make_unique<Model>(mesh, model, settings)),
      load_(parameter(model, load_step, true)) {}

RunDerivatives::~RunDerivatives() = default;

std::unique_ptr<RunDerivatives::Parameter> RunDerivatives::parameter(const FractureModel& model, double step,
                                                                     bool is_load) {
  auto found = std::make_unique<Parameter>(mesh_, model, settings_, step, is_load);
  if (found->shifted.unknowns.n_unknowns() != base_->unknowns.n_unknowns())
    throw InputError("a greater value gives the body other unknowns: materials that were alike no longer are");
  const CellField<double>&before = base_->model.initial_damage, &after = found->shifted.model.initial_damage;
  for (Index c = 0; c < after.size(); ++c) found->derivative.damage[c] = (after[c] - before[c]) / step;
  return found;
}

void RunDerivatives::add(const FractureModel& shifted, double step) {
  parameters_.push_back(parameter(shifted, step, false));
}

const RunDerivatives::Derivative& RunDerivatives::by(std::size_t k) const { return parameters_[k]->derivative; }
const RunDerivatives::Derivative& RunDerivatives::by_load() const { return load_->derivative; }

Index RunDerivatives::iterations() const {
  Index n = load_->derivative.iterations;
  for (const auto& p : parameters_) n += p->derivative.iterations;
  return n;
}

const RunDerivatives::Jump& RunDerivatives::jump(std::size_t k) const { return parameters_[k]->jump; }

void RunDerivatives::follow(const FractureState& start, const FractureState& state, bool jumped) {
  if (jumped && last_) {
    if (earlier_) find_jump(*earlier_, &Parameter::earlier_right_side);
    const std::vector<double> scale = find_jump(*last_, &Parameter::right_side);
    for (const auto& p : parameters_) go_to_jump(start, scale, *p);
  }
  Step step = step_of(start, state);
  Linearised at = linearised(step);
  if (jumped) load_->answer.clear();
  differentiate(step, at, *load_);
  for (const auto& p : parameters_) {
    if (jumped) p->answer.clear();
    differentiate(step, at, *p);
  }
  earlier_ = std::exchange(last_, std::make_unique<Step>(std::move(step)));
}

RunDerivatives::Step RunDerivatives::step_of(const FractureState& start, const FractureState& state) const {
  const CellField<double> lower = base_->model.lower_bound(start.damage);
  const DamageEquation& damage = base_->staggered.damage_equation();
  const std::size_t n = as_size(mesh_.n_cells());
  Step step{state, start.interfaces, ConjugateGradients::Held(n, 1), std::vector<char>(n, 0)};
  for (Index c = 0; c < mesh_.n_cells(); ++c) {
    if (damage.is_damageable(c) && state.damage[c] > lower[c] && state.damage[c] < 1.0) step.held[c] = 0;
    if (state.damage[c] == lower[c] && lower[c] == start.damage[c]) step.inherits[c] = 1;
  }
  return step;
}

RunDerivatives::Linearised RunDerivatives::linearised(const Step& step) {
  Staggered& staggered = base_->staggered;
  Linearised at{unbalanced_of(staggered, step.state, step.before), nullptr};
  std::vector<Vector> unchanged = step.state.displacement;  // the solution makes the preconditioner
  staggered.momentum().solve(step.state.load, {.reduction = 1.0, .ceiling = 1.0, .floor = 1.0, .most_iterations = 0},
                             unchanged);
  const bool all_held = std::ranges::count(step.held, 0) == 0;
  at.system = std::make_unique<CoupledSystem>(
      staggered.momentum(), staggered.damage_equation(),
      all_held ? CellField<IsotropicElasticity>() : staggered.stiffness().degradable_part(step.state), step.state,
      step.held);
  return at;
}

/// The answer of the cells whose damage is that of the step before; zero elsewhere.
std::vector<Vector> RunDerivatives::inherited(const Step& step, const CoupledSystem& system, const Parameter& p) const {
  std::vector<Vector> x(system.size(), Vector::Zero());
  if (p.is_load) return x;
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (system.is_held(c) && step.inherits[c] != 0) system.of(x, c) = p.derivative.damage[c] * system.root(c);
  return x;
}

/// The answer of the step before, in proportion to the load.
void RunDerivatives::extrapolate(double share, const CoupledSystem& system, const Parameter& p,
                                 std::vector<Vector>& x) const {
  for (std::size_t i = 0; i < system.n_displacements(); ++i) x[i] = share * p.answer[i];
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (!system.is_held(c)) system.of(x, c) = share * p.derivative.damage[c] * system.root(c);
}

void RunDerivatives::differentiate(const Step& step, Linearised& at, Parameter& p) {
  CoupledSystem& system = *at.system;
  std::vector<Vector> x = inherited(step, system, p);
  FractureState moved = step.state;
  if (p.is_load) moved.load *= 1.0 + p.step;
  Unbalanced rest;
  const auto unsolved = [&] {
    at.move(step.state, x, p.step, moved);
    p.shifted.staggered.balance().prescribe(moved.load, moved.displacement);
    rest = unbalanced_of(p.shifted.staggered, moved, p.is_load ? step.before : p.interfaces);
    return at.difference(rest, p.step);
  };
  std::vector<Vector> b = unsolved();
  const std::vector<double> scale = system.scale();
  p.earlier_right_side = std::exchange(p.right_side, b);
  const double whole = std::max(scaled_norm(b, scale), share_by_load * scaled_norm(load_->right_side, scale));
  p.derivative.iterations = 0;
  if (!p.answer.empty() && last_ && last_->state.load > 0.0) {
    extrapolate(step.state.load / last_->state.load, system, p, x);
    b = unsolved();
  }
  double norm = scaled_norm(b, scale), last = norm;
  for (int k = 0; k < most_refinements && norm > least_unsolved * whole && (k < 2 || norm < 0.5 * last); ++k) {
    std::vector<Vector> change(system.size(), Vector::Zero());
    const double due = std::clamp(0.5 * least_unsolved * whole / norm, reduction_of_solution, 0.5);
    p.derivative.iterations += system.solve(b, due, most_linear_iterations, change).iterations;
    parallel_for(count_of(x), [&](Index i) { x[i] += change[i]; });
    b = unsolved();
    last = std::exchange(norm, scaled_norm(b, scale));
  }
  p.derivative.unsolved = whole > 0.0 ? norm / whole : 0.0;
  p.answer = std::move(x);
  keep(step, at, moved, rest, p);
}

void RunDerivatives::keep(const Step& step, const Linearised& at, const FractureState& moved, const Unbalanced& rest,
                          Parameter& p) const {
  Derivative& found = p.derivative;
  const auto n = static_cast<std::ptrdiff_t>(at.system->n_displacements());
  found.displacement.assign(p.answer.begin(), p.answer.begin() + n);
  for (Index c = 0; c < mesh_.n_cells(); ++c) found.damage[c] = at.system->of(p.answer, c) / at.system->root(c);
  std::vector<Vector> change = rest.boundary_force;
  for (std::size_t f = 0; f < change.size(); ++f) change[f] = (change[f] - at.base.boundary_force[f]) / p.step;
  found.reaction = sums_by_patch(mesh_, change);
  const MomentumOperator& balance = base_->staggered.balance();
  found.patch_displacement = balance.patch_displacements(moved.displacement);
  const std::vector<Vector> unmoved = balance.patch_displacements(step.state.displacement);
  for (std::size_t i = 0; i < unmoved.size(); ++i)
    found.patch_displacement[i] = (found.patch_displacement[i] - unmoved[i]) / p.step;
  p.earlier = std::exchange(p.interfaces, rest.interfaces);
}

// What is frozen by the jump has been reached along the path of the load, without the part that grows beyond all
// bounds.
void RunDerivatives::go_to_jump(const FractureState& last, const std::vector<double>& scale, Parameter& p) const {
  std::vector<Vector> u = last.displacement;
  const double square = scaled_dot(load_->answer, load_->answer, scale);
  const double load = square > 0.0 ? -scaled_dot(load_->answer, p.answer, scale) / square : 0.0;
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] += p.step * (p.derivative.displacement[i] + load * load_->derivative.displacement[i]);
  for (Index c = 0; c < mesh_.n_cells(); ++c) p.derivative.damage[c] += load * load_->derivative.damage[c];
  const Staggered& staggered = p.shifted.staggered;
  staggered.faces().advance(staggered.balance(), u, p.earlier, p.interfaces);
}

// Inverse iteration in the norm of the diagonal, from the answer by the load.
std::vector<double> RunDerivatives::find_jump(const Step& last, std::vector<Vector> Parameter::*right_side) {
  const Linearised at = linearised(last);
  std::vector<double> scale = at.system->scale();
  std::vector<Vector> null = load_->answer;
  for (int k = 0; k < null_iterations; ++k) {
    std::vector<Vector> b = null;
    const double size = std::sqrt(dot(null, null));
    for (std::size_t i = 0; i < b.size(); ++i) b[i] /= scale[i] * scale[i] * size;
    std::ranges::fill(null, Vector::Zero());
    at.system->solve(b, null_reduction, most_linear_iterations, null);
  }
  const double by_load = dot(null, (*load_).*right_side);
  for (const auto& p : parameters_) {
    const double load = by_load != 0.0 ? -dot(null, (*p).*right_side) / by_load : 0.0;
    p->jump = {.load = load, .changed = std::abs(load - p->jump.load)};
  }
  return scale;
}

}  // namespace pfdm
