#include "solver/fracture/equilibrium/cohesive_path.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
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
      target = tolerance.target(step.initial_residual);
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
