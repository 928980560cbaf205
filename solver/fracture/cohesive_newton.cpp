#include "solver/fracture/cohesive_newton.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr Index most_solves = 1000;
constexpr double falls = 0.7;              // of the residual by a step of Newton's that leads on
constexpr Index first_secants = 4;         // steps in between if it does not; then twice as many, and so on
constexpr double linear_reduction = 0.02;  // of the residual of the linearised equation

/// Whether the next step is by tangent or by secant. Secant steps lead from below to what breaks next, however far that
/// is; where tangents do not lead on, the iteration goes back to where the secants had come to.
class WayOut {
 public:
  explicit WayOut(const std::vector<Vector>& u) : kept_(u) {}

  CohesiveFaces::Way next(double residual, std::vector<Vector>& u) {
    using enum CohesiveFaces::Way;
    if (secants_left_ > 0) {
      if (--secants_left_ > 0) return secant;
      kept_ = u;
      misses_ = 0;
      least_ = std::numeric_limits<double>::infinity();
      return tangent;
    }
    misses_ = residual < falls * least_ ? 0 : misses_ + 1;
    least_ = std::min(least_, residual);
    if (misses_ <= bearable_misses) return tangent;
    u = kept_;
    secants_left_ = secants_;
    secants_ = std::min<Index>(2 * secants_, most_secants);
    return secant;
  }

 private:
  static constexpr Index bearable_misses = 3, most_secants = 32;  // faces that pass their strength raise the residual
  std::vector<Vector> kept_;
  double least_ = std::numeric_limits<double>::infinity();  // residual since the last secant
  Index misses_ = 0, secants_left_ = 0, secants_ = first_secants;
};

/// Residual that is small enough, given that at the start.
double target_of(const MomentumSolver::Tolerance& tolerance, double initial) {
  return std::max(tolerance.floor, std::min(tolerance.ceiling, tolerance.reduction * initial));
}

}  // namespace

Equilibrium solve_with_faces(const CohesiveFaces& faces, const std::vector<InterfaceHistory>& before, double t,
                             const MomentumSolver::Tolerance& tolerance, MomentumSolver& momentum,
                             std::vector<Vector>& u) {
  Equilibrium whole{.converged = false, .iterations = 0, .initial_residual = 0.0, .residual = 0.0};
  double target = 0.0;
  WayOut way_out(u);
  CohesiveFaces::Way way = CohesiveFaces::Way::tangent;
  for (Index k = 0; k < most_solves; ++k) {
    // The residual at the start of a solve is that of the true laws.
    faces.linearise(u, before, way, momentum);
    const Equilibrium step = momentum.solve(t,
                                            {.reduction = linear_reduction,
                                             .ceiling = 1.0,
                                             .floor = 0.5 * target,
                                             .most_iterations = tolerance.most_iterations},
                                            u);
    whole.iterations += step.iterations;
    whole.residual = step.initial_residual;
    if (k == 0) {
      whole.initial_residual = step.initial_residual;
      target = target_of(tolerance, step.initial_residual);
    }
    whole.converged = step.initial_residual <= target;
    if (whole.converged || !std::isfinite(step.residual)) return whole;
    way = way_out.next(step.initial_residual, u);
  }
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
    parallel_for(static_cast<Index>(a.size()),
                 [&](Index i) { sum[as_size(i)] = a[as_size(i)] + factor * b[as_size(i)]; });
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
    parallel_for(static_cast<Index>(line.u.size()),
                 [&](Index i) { line.slope[as_size(i)] = (line.slope[as_size(i)] - line.u[as_size(i)]) / apart; });
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

  /// Where nothing dissipates yet: the greatest load, or a smaller one that does not dissipate more than it may.
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
    faces.linearise(u, before, CohesiveFaces::Way::tangent, momentum);
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
