#include "solver/fracture/equilibrium/finite_newton.h"

#include "physics/materials/potential.h"
#include "solver/momentum/finite_strain/finite_tractions.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr Index most_cuts = 8;
constexpr double newton_reduction = 0.02;  // of the residual by one linear solve
constexpr double little_descent = 1.0 - 1e-4;

double work(const std::vector<Vector>& force, const std::vector<Vector>& step, Index n_nodes) {
  return parallel_sum(n_nodes, [&](Index i) { return force[i].dot(step[i]); });
}

/// Finds the part of a Newton step that may be taken.
struct LineSearch {
  const CellStiffness& stiffness;
  MomentumSolver& momentum;
  FractureState& state;
  const std::vector<Vector> from;
  const std::vector<Vector> rest;  // unbalanced forces there

  LineSearch(const CellStiffness& law, MomentumSolver& balance, FractureState& at)
      : stiffness(law),
        momentum(balance),
        state(at),
        from(at.displacement),
        rest(balance.unbalanced_forces(at.load, at.displacement)) {}

  void go_back(double before, double& residual) {
    state.displacement = from;
    stiffness.set(state, momentum);
    residual = before;
  }

  bool works_less(const std::vector<Vector>& step) const {
    constexpr double less = 0.5;
    const Index n = momentum.n_nodes();
    const double now = work(momentum.unbalanced_forces(state.load, state.displacement), step, n);
    return std::abs(now) <= less * std::abs(work(rest, step, n));
  }

  // The state's displacements are those at the end of the whole step. Returns the fraction of it, or 0; `residual` is
  // that which has to fall, unless it is small enough, and becomes the one there.
  double shorten(double small_enough, double& residual) {
    std::vector<Vector> step = state.displacement;
    for (std::size_t i = 0; i < step.size(); ++i) step[i] -= from[i];
    const double before = residual;
    double part = 1.0;
    for (Index cuts = 0; cuts <= most_cuts; ++cuts, part *= 0.5) {
      parallel_for(count_of(step), [&](Index i) { state.displacement[i] = from[i] + part * step[i]; });
      stiffness.set(state, momentum);
      if (inverts(momentum.balance())) continue;
      residual = momentum.residual(state.load, state.displacement);
      if (residual < little_descent * before || residual <= small_enough || works_less(step)) return part;
    }
    go_back(before, residual);
    return 0.0;
  }
};

}  // namespace

bool inverts(const MomentumOperator& balance) {
  constexpr double damaged = 0.5;
  if (balance.finite() == nullptr) return false;
  const FiniteStates& states = balance.finite()->states();
  return parallel_sum(states.deformation().size(), [&](Index c) {
           return !states.is_softer(c, damaged) && states.elastic_volume(c) < least_volume ? 1.0 : 0.0;
         }) > 0.0;
}

Equilibrium solve_finite(const CellStiffness& stiffness, const MomentumSolver::Tolerance& tolerance,
                         MomentumSolver& momentum, FractureState& state, Index most_steps) {
  Equilibrium total;
  double target = 0.0;
  for (Index step = 0; step < most_steps; ++step) {
    LineSearch search(stiffness, momentum, state);
    const Equilibrium linear = momentum.solve(state.load,
                                              {.reduction = std::max(newton_reduction, 0.5 * tolerance.reduction),
                                               .ceiling = std::numeric_limits<double>::max(),
                                               .floor = 0.1 * tolerance.floor,
                                               .most_iterations = tolerance.most_iterations,
                                               .good_enough = 0.0},
                                              state.displacement);
    if (step == 0) {
      total.initial_residual = linear.initial_residual;
      target = tolerance.target(linear.initial_residual);
    }
    total.iterations += linear.iterations;
    total.residual = linear.initial_residual;
    if (linear.iterations == 0) {
      total.converged = linear.converged;
      break;
    }
    const double part = search.shorten(target, total.residual);
    total.converged = part == 1.0 && total.residual <= target;
    const bool stagnates = total.residual <= tolerance.good_enough && total.residual > 0.5 * linear.initial_residual;
    if (part == 0.0 && total.residual > std::max(target, tolerance.good_enough))
      total.residual = std::numeric_limits<double>::infinity();
    if (total.converged || stagnates || part == 0.0) break;
  }
  return total;
}

}  // namespace pfdm
