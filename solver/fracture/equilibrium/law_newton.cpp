#include "solver/fracture/equilibrium/law_newton.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr Index most_law_steps = 40;
constexpr double reduction_of_step = 1e-3;  // of the residual by one linear solve
constexpr double stagnant = 0.9;            // what is left of it by one that ends on its iterations, and others like it

double work_along(const std::vector<Vector>& step, Index n_nodes, const std::vector<Vector>& force) {
  return parallel_sum(n_nodes, [&](Index i) { return force[i].dot(step[i]); });
}

// The displacements of the state are those at the end of a step from `from`, where the unbalanced forces `rest` act.
// Shortens a step that leads beyond the least energy along it, up to a place near that. Slopes are continuous, but
// steep beyond a crack that closes: a place just before it would be left out of the next linearisation, and the next
// step as short. The balance is linearised about the result.
void search_line(const CellStiffness& stiffness, const std::vector<Vector>& from, const std::vector<Vector>& rest,
                 MomentumSolver& momentum, FractureState& state) {
  constexpr int most_tries = 16;
  constexpr double near_enough = 0.2;  // of the work along the step
  std::vector<Vector> step = state.displacement;
  for (std::size_t i = 0; i < step.size(); ++i) step[i] -= from[i];
  const Index n = momentum.n_nodes();
  const auto slope_at_state = [&] {
    stiffness.set(state, momentum);
    return work_along(step, n, momentum.unbalanced_forces(state.load, state.displacement));
  };
  const double work = work_along(step, n, rest);
  double below = 0.0, at_below = work, above = 1.0, at_above = slope_at_state();
  if (!(work > 0.0)) return;
  double part = 1.0, now = at_above;
  for (int tries = 0; tries < most_tries && (now < -near_enough * work || (now > near_enough * work && part < 1.0));
       ++tries) {
    part = below + (above - below) * std::clamp(at_below / (at_below - at_above), 0.02, 0.9);
    parallel_for(count_of(step), [&](Index i) { state.displacement[i] = from[i] + part * step[i]; });
    now = slope_at_state();
    // Illinois: an end that stays counts half the next time.
    if (now > 0.0)
      below = part, at_below = now, at_above *= 0.5;
    else
      above = part, at_above = now, at_below *= 0.5;
  }
}

}  // namespace

Equilibrium solve_with_laws(const CellStiffness& stiffness, const MomentumSolver::Tolerance& tolerance,
                            MomentumSolver& momentum, FractureState& state) {
  momentum.balance().prescribe(state.load, state.displacement);
  stiffness.set(state, momentum);
  Equilibrium total;
  total.residual = total.initial_residual = momentum.residual(state.load, state.displacement);
  const double target = tolerance.target(total.initial_residual);
  // Of materials with inclined axes plates have slow modes that a part of a cycle leaves as they are.
  const Index whole_cycle = momentum.balance().is_of_third_order() ? momentum.restart_length() : 0;
  for (Index k = 0; k < most_law_steps && total.residual > target; ++k) {
    const std::vector<Vector> from = state.displacement;
    const std::vector<Vector> rest = momentum.unbalanced_forces(state.load, from);
    const Equilibrium linear = momentum.solve(state.load,
                                              {.reduction = reduction_of_step,
                                               .ceiling = std::numeric_limits<double>::max(),
                                               .floor = 0.5 * target,
                                               .most_iterations = std::max(tolerance.most_iterations, whole_cycle),
                                               .good_enough = 0.0},
                                              state.displacement);
    total.iterations += linear.iterations;
    ++total.newton_steps;
    search_line(stiffness, from, rest, momentum, state);
    const double before = total.residual;
    total.residual = momentum.residual(state.load, state.displacement);
    if (linear.iterations == 0 || (!linear.converged && total.residual > stagnant * before)) break;
  }
  total.converged = total.residual <= std::max(target, tolerance.good_enough);
  return total;
}

}  // namespace pfdm
