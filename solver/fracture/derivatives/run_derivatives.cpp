#include "solver/fracture/derivatives/run_derivatives.h"

#include "physics/error.h"
#include "solver/fracture/equilibrium/coupled_system.h"
#include "solver/momentum/stiffness_coupling.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double load_step = 1e-5;                         // relative, of the derivative by the load
constexpr double least_unsolved = 3e-5, reduction = 1e-5;  // of the right side, in all and by a solution
constexpr double null_reduction = 1e-2;                    // by an inverse iteration
constexpr int most_refinements = 6;
constexpr Index most_iterations = 300;

double dot(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  return parallel_sum(count_of(a), [&](Index i) { return a[i].dot(b[i]); });
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
  std::vector<InterfaceHistory> interfaces, earlier;  // of the shifted model, before the step and the one before it
  std::vector<Vector> right_side{}, answer{};
  double regular_load = 0.0;  // change of ln t by ln p with which the answer has no part along that by the load

  Parameter(const Mesh& mesh, const FractureModel& model, const StaggeredSettings& settings, double by, bool of_load)
      : shifted(mesh, model, settings),
        step(by),
        is_load(of_load),
        interfaces(shifted.staggered.faces().virgin_histories()),
        earlier(interfaces) {
    derivative.damage = CellField<double>(mesh.n_cells(), 0.0);
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

void RunDerivatives::follow(const FractureState& start, const FractureState& state, bool jumped) {
  Staggered& staggered = base_->staggered;
  if (jumped && !load_->answer.empty())
    for (const auto& p : parameters_) go_to_jump(start, *p);
  const Unbalanced base = unbalanced_of(staggered, state, start.interfaces);
  std::vector<Vector> unchanged = state.displacement;  // the solution makes the preconditioner
  staggered.momentum().solve(state.load, {.reduction = 1.0, .ceiling = 1.0, .floor = 1.0, .most_iterations = 0},
                             unchanged);
  const CellField<double> lower = base_->model.lower_bound(start.damage);
  const DamageEquation& damage = staggered.damage_equation();
  ConjugateGradients::Held held(as_size(mesh_.n_cells()), 1);
  bool any_is_free = false;
  for (Index c = 0; c < mesh_.n_cells(); ++c) {
    if (damage.is_damageable(c) && state.damage[c] > lower[c] && state.damage[c] < 1.0) held[as_size(c)] = 0;
    any_is_free = any_is_free || held[as_size(c)] == 0;
  }
  CoupledSystem system(staggered.momentum(), damage,
                       any_is_free ? staggered.stiffness().degradable_part(state) : CellField<IsotropicElasticity>(),
                       state, std::move(held));
  differentiate(start, state, base, system, *load_);
  for (const auto& p : parameters_) differentiate(start, state, base, system, *p);
  find_jumps(system);
}

void RunDerivatives::differentiate(const FractureState& start, const FractureState& state, const Unbalanced& base,
                                   CoupledSystem& system, Parameter& p) {
  const CellField<double> lower = base_->model.lower_bound(start.damage);
  std::vector<Vector> x(system.size(), Vector::Zero()), b(system.size(), Vector::Zero());
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (system.is_held(c) && state.damage[c] == lower[c] && lower[c] == start.damage[c])
      system.of(x, c) = p.is_load ? 0.0 : p.derivative.damage[c] * system.root(c);
  Derivative found;
  FractureState moved = state;
  if (p.is_load) moved.load *= 1.0 + p.step;
  Unbalanced rest;
  double first = 0.0, last = 0.0;
  const std::vector<double> scale = system.scale();
  for (int k = 0;; ++k) {
    parallel_for(count_of(state.displacement),
                 [&](Index i) { moved.displacement[i] = state.displacement[i] + p.step * x[i]; });
    if (p.is_load) p.shifted.staggered.balance().prescribe(moved.load, moved.displacement);
    parallel_for(mesh_.n_cells(),
                 [&](Index c) { moved.damage[c] = state.damage[c] + p.step * system.of(x, c) / system.root(c); });
    rest = unbalanced_of(p.shifted.staggered, moved, p.is_load ? start.interfaces : p.interfaces);
    parallel_for(count_of(base.forces), [&](Index i) { b[i] = (rest.forces[i] - base.forces[i]) / p.step; });
    parallel_for(mesh_.n_cells(), [&](Index c) {
      system.of(b, c) = system.is_held(c) ? 0.0 : (rest.damage[c] - base.damage[c]) / (p.step * system.root(c));
    });
    const double norm = scaled_norm(b, scale);
    if (k == 0) first = norm, p.right_side = b;
    found.unsolved = first > 0.0 ? norm / first : 0.0;
    if (found.unsolved <= least_unsolved || k == most_refinements || (k > 1 && norm > 0.5 * last)) break;
    last = norm;
    std::vector<Vector> change(system.size(), Vector::Zero());
    found.iterations += system.solve(b, reduction, most_iterations, change).iterations;
    parallel_for(count_of(x), [&](Index i) { x[i] += change[i]; });
  }
  found.displacement.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(system.n_displacements()));
  found.damage = CellField<double>(mesh_.n_cells());
  for (Index c = 0; c < mesh_.n_cells(); ++c) found.damage[c] = system.of(x, c) / system.root(c);
  found.boundary_force = rest.boundary_force;
  for (std::size_t f = 0; f < found.boundary_force.size(); ++f)
    found.boundary_force[f] = (rest.boundary_force[f] - base.boundary_force[f]) / p.step;
  const MomentumOperator& balance = base_->staggered.balance();
  found.patch_displacement = balance.patch_displacements(moved.displacement);
  const std::vector<Vector> unmoved = balance.patch_displacements(state.displacement);
  for (std::size_t i = 0; i < unmoved.size(); ++i)
    found.patch_displacement[i] = (found.patch_displacement[i] - unmoved[i]) / p.step;
  p.earlier = std::exchange(p.interfaces, std::move(rest.interfaces));
  p.answer = std::move(x);
  p.derivative = std::move(found);
}

void RunDerivatives::go_to_jump(const FractureState& last, Parameter& p) const {
  const double load = p.regular_load;
  const Derivative& by_load = load_->derivative;
  std::vector<Vector> u = last.displacement;
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] += p.step * (p.derivative.displacement[i] + load * by_load.displacement[i]);
  for (Index c = 0; c < mesh_.n_cells(); ++c) p.derivative.damage[c] += load * by_load.damage[c];
  const Staggered& staggered = p.shifted.staggered;
  staggered.faces().advance(staggered.balance(), u, p.earlier, p.interfaces);
}

void RunDerivatives::find_jumps(CoupledSystem& system) {
  const std::vector<double> scale = system.scale();
  std::vector<Vector> b = load_->answer, null(system.size(), Vector::Zero());
  for (std::size_t i = 0; i < b.size(); ++i) b[i] /= scale[i] * scale[i];  // in the norm of the diagonal
  system.solve(b, null_reduction, most_iterations, null);
  const double by_load = dot(null, load_->right_side);
  const double square = dot(b, load_->answer);
  for (const auto& p : parameters_) p->regular_load = square > 0.0 ? -dot(b, p->answer) / square : 0.0;
  for (const auto& p : parameters_)
    p->derivative.load_of_jump = by_load != 0.0 ? -dot(null, p->right_side) / by_load : 0.0;
}

}  // namespace pfdm
