#include "solver/fracture/equilibrium/coupled_newton.h"

#include "solver/fracture/equilibrium/coupled_system.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// A larger change of damage by one iteration of the alternation is a jump under way.
constexpr double jump = 0.03;
// Change over the change before: while it falls below, the alternation converges by itself.
constexpr double quick = 0.2;
// Reduction of the residual of the linear system.
constexpr double reduction = 0.05;
constexpr Index most_iterations = 60;
// Rise of the energy, relative, that equilibria which are solved to 1e-4 leave uncertain.
constexpr double bearable_rise = 1e-6;
constexpr double shrinkage = 0.25, growth = 2.0, least_radius = 0.05, most_radius = 1.0;
// Least length of a step over the change by an iteration of the alternation: a shorter one is not worth while.
constexpr double least_gain = 2.0;
constexpr int most_trials = 3, most_wait = 16;

double largest_change(const CellField<double>& from, const CellField<double>& to) {
  return parallel_max(from.size(), [&](Index c) { return std::abs(to[c] - from[c]); });
}

}  // namespace

bool CoupledNewton::suits(const Mesh& mesh, const Unknowns& unknowns) {
  return prefers_direct(mesh) && StiffnessCoupling::covers(mesh, unknowns);
}

CoupledNewton::Direction CoupledNewton::solve(const Iterate& at, const FractureState& state,
                                              const CellField<double>& answer) {
  ConjugateGradients::Held held(mesh_.n_cells(), 1);
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (damage_.is_damageable(c)) held[c] = answer[c] > at.lower[c] && answer[c] < 1.0 ? 0 : 1;
  CoupledSystem system(momentum_, damage_, part_, state, std::move(held));
  // The first guess is the step of the alternation; cells that the answer puts on a bound go there.
  std::vector<Vector> b = momentum_.unbalanced_forces(state.load, state.displacement), x(system.size(), Vector::Zero());
  b.resize(system.size(), Vector::Zero());
  for (Index c = 0; c < system.n_cells(); ++c) {
    system.of(x, c) = (answer[c] - state.damage[c]) * system.root(c);
    system.of(b, c) = system.is_held(c) ? system.of(x, c)
                                        : -damage_.imbalance(c, state.damage, state.driving_energy[c]) / system.root(c);
  }
  krylov_iterations_ = system.solve(b, reduction, most_iterations, x).iterations;
  Direction direction{.u = {x.begin(), x.begin() + system.n_displacements()}, .d = CellField<double>(system.n_cells())};
  for (Index c = 0; c < system.n_cells(); ++c) direction.d[c] = system.of(x, c) / system.root(c);
  direction.slope = -parallel_sum(count_of(x), [&](Index i) { return b[i].dot(x[i]); });
  direction.largest = parallel_max(system.n_cells(), [&](Index c) { return std::abs(direction.d[c]); });
  return direction;
}

// Negative shares lead the other way.
void CoupledNewton::go(double share, const CellField<double>& lower, FractureState& state) {
  base_->share = share;
  ++base_->tries;
  const Direction& direction = base_->direction;
  parallel_for(count_of(base_->u), [&](Index i) { state.displacement[i] = base_->u[i] + share * direction.u[i]; });
  parallel_for(base_->d.size(),
               [&](Index c) { state.damage[c] = std::clamp(base_->d[c] + share * direction.d[c], lower[c], 1.0); });
}

CoupledNewton::Moved CoupledNewton::retreat(const Iterate& at, FractureState& state, CellField<double>& answer) {
  const double share = shrinkage * base_->share;
  radius_ = std::abs(share) * base_->direction.largest;
  if (radius_ > least_gain * base_->change && base_->tries < most_trials) {
    go(share, at.lower, state);
    return Moved::on;
  }
  radius_ = std::max(radius_, least_radius);
  wait_ = next_wait_ = std::min(2 * next_wait_, most_wait);
  state.displacement = std::move(base_->u);
  state.damage = std::move(base_->d);
  answer = std::move(base_->answer);
  base_.reset();
  return Moved::back;
}

CoupledNewton::Moved CoupledNewton::move(const Iterate& at, FractureState& state, CellField<double>& answer) {
  krylov_iterations_ = 0;
  if (base_ && !(at.energy <= base_->energy + bearable_rise * std::abs(base_->energy)))
    return retreat(at, state, answer);
  if (base_) {
    next_wait_ = std::max(1, next_wait_ / 2);
    if (base_->tries == 1 && std::abs(base_->share) < 1.0) radius_ = std::min(growth * radius_, most_radius);
    base_.reset();
  }
  const double change = largest_change(state.damage, answer);
  begun_ = begun_ || change > quick * change_before_;
  change_before_ = change;
  if (!begun_ || wait_ > 0 || change > jump) {
    wait_ = std::max(0, wait_ - 1);
    return Moved::no;
  }
  Direction direction = solve(at, state, answer);
  if (!std::isfinite(direction.largest) || direction.largest == 0.0) return Moved::no;
  const double way = direction.slope > 0.0 ? -1.0 : 1.0, share = std::min(1.0, radius_ / direction.largest);
  base_ = Base{.u = state.displacement,
               .d = state.damage,
               .answer = answer,
               .direction = std::move(direction),
               .energy = at.energy,
               .change = change};
  go(way * share, at.lower, state);
  return Moved::on;
}

}  // namespace pfdm
