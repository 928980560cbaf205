#include "solver/fracture/equilibrium/cohesive_newton.h"

#include "solver/fracture/equilibrium/finite_newton.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr Index most_solves = 1000, most_finite_solves = 600;
constexpr double falls = 0.7;                 // of the residual by a step of Newton's that leads on
constexpr double linear_reduction = 0.02;     // of the residual of the linearised equation
constexpr double convex_reduction = 0.1;      // likewise, without what softens
constexpr Index most_newton_iterations = 80;  // of FGMRES: where the tangent is not definite more do not help
constexpr double bearable_rest = 0.3;         // of the residual, after so many

/// Whether the next step is by tangent or by its convex part. Convex steps lead from below to where the faces come to
/// rest, however far that is; where tangents do not lead on, the iteration goes back to where those had come to.
class WayOut {
 public:
  explicit WayOut(const std::vector<Vector>& u) : kept_(u) {}

  bool is_marching() const { return marching_; }

  /// After a step from `residual` whose linear equation was solved or not.
  CohesiveFaces::Way next(double residual, bool solved, std::vector<Vector>& u) {
    using enum CohesiveFaces::Way;
    return (marching_ ? comes_to_rest(residual, u) : leads_on(residual, solved, u)) ? tangent : convex;
  }

 private:
  bool leads_on(double residual, bool solved, std::vector<Vector>& u) {
    misses_ = residual < falls * least_ && solved ? 0 : misses_ + 1;
    least_ = std::min(least_, residual);
    if (misses_ <= (has_marched_ ? misses_after_march : bearable_misses) && solved) return true;
    u = kept_;
    marching_ = has_marched_ = true;
    steps_ = falling_ = 0;
    last_ = infinity;
    return false;
  }

  // The residual grows while faces break one after the other, and falls when the rest of them holds.
  bool comes_to_rest(double residual, std::vector<Vector>& u) {
    falling_ = residual < last_ ? falling_ + 1 : 0;
    last_ = residual;
    ++steps_;
    if (falling_ < falling_in_a_row_ && steps_ < most_steps) return false;
    falling_in_a_row_ = std::min<Index>(2 * falling_in_a_row_, most_steps);
    kept_ = u;
    marching_ = false;
    misses_ = 0;
    least_ = infinity;
    return true;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr Index bearable_misses = 3;  // faces that pass their strength raise the residual
  static constexpr Index misses_after_march = 2, most_steps = 32;
  std::vector<Vector> kept_;
  double least_ = infinity, last_ = infinity;  // residual since the last march, and in it
  Index misses_ = 0, steps_ = 0, falling_ = 0, falling_in_a_row_ = 4;
  bool marching_ = false, has_marched_ = false;
};

/// Residual that is small enough, given that at the start.
double target_of(const MomentumSolver::Tolerance& tolerance, double initial) {
  return std::max(tolerance.floor, std::min(tolerance.ceiling, tolerance.reduction * initial));
}

// Halves a step while it turns a sound cell inside out.
void shorten(const std::vector<Vector>& from, const CellLaws& cells, MomentumSolver& momentum, std::vector<Vector>& u) {
  constexpr int most_halvings = 8;
  cells();
  for (int k = 0; k < most_halvings && inverts(momentum.balance()); ++k) {
    parallel_for(count_of(u), [&](Index i) { u[i] = 0.5 * (from[i] + u[i]); });
    cells();
  }
}

}  // namespace

Equilibrium solve_with_faces(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before, double t,
                             const MomentumSolver::Tolerance& tolerance, const CellLaws& cells,
                             MomentumSolver& momentum, std::vector<Vector>& u, std::vector<InterfaceHistory>& after,
                             const BalanceWatch& watch) {
  Equilibrium whole{.converged = false, .iterations = 0, .initial_residual = 0.0, .residual = 0.0};
  double target = 0.0, last = std::numeric_limits<double>::infinity();
  WayOut way_out(u);
  std::vector<Vector> from;  // before the step
  CohesiveFaces::Way way = CohesiveFaces::Way::tangent;
  const bool has_rate = faces.has_rate_laws();  // steep where faces begin to move
  momentum.set_held_forces(faces.branch_forces(before));
  const Index most = cells ? most_finite_solves : most_solves;
  for (Index k = 0; k < most; ++k) {
    // The residual at the start of a solve is that of the true laws; at finite strain to the second order in what
    // `settle` moves.
    const bool newton = way == CohesiveFaces::Way::tangent;
    if (has_rate) {
      momentum.balance().prescribe(t, u);
      faces.settle(before, momentum.balance(), u, after);
    }
    if (has_rate || cells || tolerance.good_enough > 0.0) from = u;
    faces.linearise(u, before, after, way, momentum);
    if (watch && k > 0) watch(k, whole.residual);
    const Equilibrium step =
        momentum.solve(t,
                       {.reduction = newton ? linear_reduction : convex_reduction,
                        .ceiling = 1.0,
                        .floor = 0.5 * target,
                        .most_iterations = newton ? most_newton_iterations : tolerance.most_iterations,
                        .whole_cycle = !newton},
                       u);
    if (cells) shorten(from, cells, momentum, u);
    whole.iterations += step.iterations;
    whole.residual = step.initial_residual;
    if (k == 0) {
      whole.initial_residual = step.initial_residual;
      target = target_of(tolerance, step.initial_residual);
    }
    whole.converged = step.initial_residual <= target;
    if (whole.converged && has_rate) {  // the overstresses belong to it
      u = std::move(from);
      if (cells) cells();
      return whole;
    }
    if (whole.converged || !std::isfinite(step.residual)) return whole;
    const bool solved = step.residual < bearable_rest * step.initial_residual;
    if (step.initial_residual <= tolerance.good_enough && !(solved && step.initial_residual < falls * last)) {
      u = std::move(from);
      if (cells) cells();
      return whole;
    }
    if (!has_rate && (way_out.is_marching() || step.initial_residual > falls * last))
      faces.settle(before, momentum.balance(), u, after);
    last = step.initial_residual;
    way = way_out.next(step.initial_residual, solved, u);
    if (cells) cells();
  }
  if (has_rate) faces.settle(before, momentum.balance(), u, after);
  if (cells) whole.residual = std::numeric_limits<double>::infinity();
  return whole;
}

namespace {

constexpr Index most_turns = 60;         // of path-following
constexpr double path_precision = 1e-3;  // of the dissipation
constexpr double load_apart = 0.02;      // of the load, between the two solutions
constexpr double furthest = 0.3;         // change of the load in a turn

/// Solutions of the linearised equations: of the load, and how they change with it.
struct SolutionLine {
  double load;
  std::vector<Vector> u, slope;

  std::vector<Vector> at(double t) const { return combined(u, t - load, slope); }
  static std::vector<Vector> combined(const std::vector<Vector>& a, double factor, const std::vector<Vector>& b) {
    std::vector<Vector> sum(a.size());
    parallel_for(count_of(a), [&](Index i) { sum[i] = a[i] + factor * b[i]; });
    return sum;
  }
};

/// Follows the path of one step.
struct PathFollower {
  const CohesiveFaces& faces;
  const std::vector<InterfaceHistory>& before;
  const FacesPath& path;
  MomentumSolver& momentum;
  MomentumSolver::Tolerance inner;

  double excess(const std::vector<Vector>& u) const {
    return faces.dissipated_at(momentum.balance(), u, before) - path.dissipation;
  }

  Index complete(SolutionLine& line) const {
    line.slope = line.u;
    const double apart = load_apart * line.load;
    const Index iterations = momentum.solve(line.load + apart, inner, line.slope).iterations;
    parallel_for(count_of(line.u), [&](Index i) { line.slope[i] = (line.slope[i] - line.u[i]) / apart; });
    return iterations;
  }

  /// The load at which the faces dissipate what they may, to first order about u.
  double next_load(const SolutionLine& line, const std::vector<Vector>& u) const {
    const double most = std::min(path.most_load, (1.0 + furthest) * line.load);
    const double growth = faces.dissipation_growth(momentum.balance(), u, before, line.slope);
    if (growth == 0.0) return first_load(line, most);
    const std::vector<Vector> change = SolutionLine::combined(line.u, -1.0, u);
    const double due = -excess(u) - faces.dissipation_growth(momentum.balance(), u, before, change);
    return std::clamp(line.load + due / growth, (1.0 - furthest) * line.load, most);
  }

  /// First load, where nothing dissipates yet: the greatest one, or a smaller one that does not dissipate more than it
  /// may.
  double first_load(const SolutionLine& line, double most) const {
    double load = most;
    for (int i = 0; i < 40 && excess(line.at(load)) > 0.0; ++i) load = 0.5 * (load + line.load);
    return load;
  }
};

}  // namespace

Equilibrium follow_with_faces(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before,
                              const FacesPath& path, const MomentumSolver::Tolerance& tolerance,
                              MomentumSolver& momentum, double& load, std::vector<Vector>& u) {
  const PathFollower follower{.faces = faces,
                              .before = before,
                              .path = path,
                              .momentum = momentum,
                              .inner = {.reduction = 1e-4,
                                        .ceiling = 1.0,
                                        .floor = 0.1 * tolerance.floor,
                                        .most_iterations = tolerance.most_iterations}};
  Equilibrium whole;
  double target = 0.0;
  for (Index k = 0; k < most_turns; ++k) {
    faces.linearise(u, before, before, CohesiveFaces::Way::tangent, momentum);
    const double excess = follower.excess(u);
    SolutionLine line{.load = load, .u = u, .slope = {}};
    const Equilibrium step = momentum.solve(load, follower.inner, line.u);
    whole.iterations += step.iterations;
    whole.residual = step.initial_residual;
    if (k == 0) {
      whole.initial_residual = step.initial_residual;
      target = target_of(tolerance, step.initial_residual);
    }
    const bool keeps_limit = load >= path.most_load ? excess <= path_precision * path.dissipation
                                                    : std::abs(excess) <= path_precision * path.dissipation;
    whole.converged = step.initial_residual <= target && keeps_limit;
    if (whole.converged || !std::isfinite(step.residual)) return whole;
    whole.iterations += follower.complete(line);
    load = follower.next_load(line, u);
    u = line.at(load);
  }
  whole.residual = std::numeric_limits<double>::infinity();  // the step is to be cut
  return whole;
}

}  // namespace pfdm
