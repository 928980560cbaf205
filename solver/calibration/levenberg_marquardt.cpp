#include "solver/calibration/levenberg_marquardt.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The problem as Ceres sees it, each entry of x a block of its own.
class Cost : public ceres::CostFunction {
 public:
  Cost(const LeastSquaresProblem& problem, VectorXd start, VectorXd residuals, double robust_scale)
      : problem_(problem), at_(std::move(start)), residuals_(std::move(residuals)), robust_scale_(robust_scale) {
    set_num_residuals(static_cast<int>(residuals_.size()));
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(at_.size()), 1);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    VectorXd x(at_.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) x[j] = parameters[j][0];
    if (!move_to(x)) return false;
    for (Eigen::Index i = 0; i < residuals_.size(); ++i) residuals[i] = robust(residuals_[i]);
    if (jacobians == nullptr) return true;
    const auto J = problem_.jacobian(x);
    if (!J || !J->allFinite()) return false;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      if (jacobians[j] == nullptr) continue;
      for (Eigen::Index i = 0; i < J->rows(); ++i) jacobians[j][i] = robust_slope(residuals_[i]) * (*J)(i, j);
    }
    return true;
  }

 private:
  /// Ceres asks twice for the residuals where it takes a Jacobian.
  bool move_to(const VectorXd& x) const {
    if (x == at_) return true;
    auto r = problem_.residuals(x);
    if (!r || !r->allFinite()) return false;
    at_ = x;
    residuals_ = std::move(*r);
    return true;
  }

  bool is_large(double r) const { return robust_scale_ > 0.0 && std::abs(r) > robust_scale_; }
  /// Huber's loss as a square: 2 d |r| - d^2 beyond d. (Ceres would apply a loss to the whole block at once.)
  double robust(double r) const {
    const double d = robust_scale_;
    return is_large(r) ? std::copysign(std::sqrt(2.0 * d * std::abs(r) - d * d), r) : r;
  }
  double robust_slope(double r) const { return is_large(r) ? robust_scale_ / std::abs(robust(r)) : 1.0; }

  const LeastSquaresProblem& problem_;
  mutable VectorXd at_;  // where the residuals are known
  mutable VectorXd residuals_;
  double robust_scale_;
};

class Recorder : public ceres::IterationCallback {
 public:
  Recorder(const LeastSquaresSettings& settings, LeastSquaresResult& result) : settings_(settings), result_(result) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.step_is_successful || summary.iteration == 0) {
      result_.path.push_back({result_.x, summary.cost});
      if (settings_.iterated) settings_.iterated(result_.path.back());
    }
    // Before the first successful step Ceres 2.2 leaves the norm at zero.
    const bool was_tried = summary.iteration > 0 && summary.step_is_valid && summary.step_norm > 0.0;
    gave_up_ = gave_up_ || is_hopeless(summary.iteration);
    const bool is_over = gave_up_ || (was_tried && summary.step_norm < settings_.least_step);
    return is_over ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  bool gave_up() const { return gave_up_; }

 private:
  bool is_hopeless(int iteration) const {
    constexpr std::size_t last = 4;
    constexpr double faster = 3.0;
    const std::vector<LeastSquaresPoint>& path = result_.path;
    if (!std::isfinite(settings_.due_cost) || path.size() <= last) return false;
    const double cost = path.back().cost, pace = (path[path.size() - 1 - last].cost - cost) / last;
    return cost - faster * pace * (settings_.maximum_iterations - iteration) > settings_.due_cost;
  }

  const LeastSquaresSettings& settings_;
  LeastSquaresResult& result_;
  bool gave_up_ = false;
};

ceres::Solver::Options options_of(const LeastSquaresSettings& settings) {
  ceres::Solver::Options options;
  options.max_num_iterations = settings.maximum_iterations;
  options.function_tolerance = settings.cost_tolerance;
  options.initial_trust_region_radius = settings.trust_radius;
  options.parameter_tolerance = settings.tolerance;
  options.gradient_tolerance = 1e-18;
  // With bounds Ceres would search along a step that makes the sum of squares larger, by its gradient at each trial: a
  // run of the model for each parameter and side. A smaller trust region costs one.
  options.max_num_line_search_step_size_iterations = 0;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  options.max_num_consecutive_invalid_steps = 20;
  options.num_threads = 1;
  return options;
}

std::optional<MatrixXd> central_differences(const LeastSquaresProblem& problem, const VectorXd& x) {
  constexpr double step = 6e-6;  // cube root of the rounding
  MatrixXd J;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double h = step * std::max(1.0, std::abs(x[j]));
    const auto ahead = problem.residuals(x + h * VectorXd::Unit(x.size(), j));
    const auto behind = problem.residuals(x - h * VectorXd::Unit(x.size(), j));
    if (!ahead || !behind) return std::nullopt;
    if (j == 0) J.resize(ahead->size(), x.size());
    J.col(j) = (*ahead - *behind) / (2.0 * h);
  }
  return J;
}

/// The minimum from `start` on, with the entries that are `held` as they are.
LeastSquaresResult minimise(const LeastSquaresProblem& problem, const VectorXd& start, const std::vector<bool>& held,
                            const LeastSquaresSettings& settings) {
  LeastSquaresResult result{.x = start, .message = {}, .path = {}};
  auto at_start = problem.residuals(start);
  if (!at_start || !at_start->allFinite()) {
    result.message = "the model does not converge at the start";
    return result;
  }
  std::vector<double*> blocks;
  for (double& entry : result.x) blocks.push_back(&entry);
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new Cost(problem, start, std::move(*at_start), settings.robust_scale), nullptr,
                                 blocks);
  for (std::size_t j = 0; j < blocks.size(); ++j) {
    if (held[j]) ceres_problem.SetParameterBlockConstant(blocks[j]);
    if (problem.bounds.empty()) continue;
    const auto [lower, upper] = problem.bounds[j];
    if (std::isfinite(lower)) ceres_problem.SetParameterLowerBound(blocks[j], 0, lower);
    if (std::isfinite(upper)) ceres_problem.SetParameterUpperBound(blocks[j], 0, upper);
  }
  ceres::Solver::Options options = options_of(settings);
  Recorder recorder(settings, result);
  options.callbacks.push_back(&recorder);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  const bool stopped_here = summary.termination_type == ceres::USER_SUCCESS;
  result.converged = !recorder.gave_up() && (stopped_here || summary.termination_type == ceres::CONVERGENCE);
  result.message = recorder.gave_up() ? "at its pace it would not come down to what is due"
                   : stopped_here     ? fmt::format("the last step was shorter than {:g}", settings.least_step)
                                      : summary.message;
  if (summary.IsSolutionUsable()) result.cost = summary.final_cost;
  return result;
}

/// Which entries are at a bound beyond which the sum of squares decreases.
std::vector<bool> pressed_at_bounds(const LeastSquaresProblem& problem, const VectorXd& x, std::vector<bool> held) {
  std::vector<int> sides(held.size(), 0);
  for (std::size_t j = 0; j < problem.bounds.size(); ++j) sides[j] = side_of_bound(x[j], problem.bounds[j]);
  if (std::ranges::count(sides, 0) == std::ssize(sides)) return std::vector<bool>(held.size(), false);
  const auto r = problem.residuals(x);
  const auto J = problem.jacobian(x);
  if (!r || !J) return held;
  const VectorXd gradient = J->transpose() * *r;
  for (std::size_t j = 0; j < held.size(); ++j) held[j] = sides[j] != 0 && sides[j] * gradient[j] < 0.0;
  return held;
}

}  // namespace

int side_of_bound(double x, const std::pair<double, double>& bounds) {
  const double near = 1e-9 * std::max(1.0, std::abs(x));
  return x - bounds.first <= near ? -1 : bounds.second - x <= near ? 1 : 0;
}

/// Ceres truncates steps at the bounds, which stalls where parameters are correlated. Entries that have reached a bound
/// are therefore held there while the others continue, and released if the sum of squares decreases inwards.
LeastSquaresResult minimise(const LeastSquaresProblem& problem, const VectorXd& start,
                            const LeastSquaresSettings& settings) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres would report every step at which the model fails
  LeastSquaresProblem whole = problem;
  if (!whole.jacobian) whole.jacobian = [&](const VectorXd& x) { return central_differences(problem, x); };
  std::vector<bool> held(start.size(), false);
  LeastSquaresResult result = minimise(whole, start, held, settings);
  for (std::size_t turn = 0; turn < 2 * held.size() && std::isfinite(result.cost); ++turn) {
    std::vector<bool> now = pressed_at_bounds(whole, result.x, held);
    if (now == held || std::ranges::count(now, false) == 0) break;
    held = std::move(now);
    LeastSquaresResult next = minimise(whole, result.x, held, settings);
    if (!(next.cost <= result.cost)) break;
    next.path.insert(next.path.begin(), result.path.begin(), result.path.end());
    result = std::move(next);
  }
  return result;
}

}  // namespace pfdm
