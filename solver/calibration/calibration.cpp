#include "solver/calibration/calibration.h"

#include "physics/error.h"
#include "solver/calibration/calibration_scale.h"
#include "solver/calibration/calibration_starts.h"
#include "solver/calibration/calibration_statistics.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// The model as Ceres sees it: residuals and priors as functions of the scaled parameters.
class Cost : public ceres::CostFunction {
 public:
  Cost(const ScaledModel& model, std::size_t n_residuals, double robust_scale)
      : model_(model), robust_scale_(robust_scale) {
    set_num_residuals(static_cast<int>(n_residuals));
    mutable_parameter_block_sizes()->assign(model.n_parameters(), 1);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Eigen::VectorXd u(static_cast<Eigen::Index>(model_.n_parameters()));
    for (Eigen::Index j = 0; j < u.size(); ++j) u[j] = parameters[j][0];
    const auto r = model_.residuals(u);
    if (!r) return false;
    for (std::size_t i = 0; i < r->size(); ++i) residuals[i] = robust((*r)[i]);
    if (jacobians == nullptr) return true;
    const auto J = model_.jacobian(u);
    if (!J) return false;
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      if (jacobians[j] == nullptr) continue;
      for (Eigen::Index i = 0; i < J->rows(); ++i)
        jacobians[j][i] = robust_slope((*r)[static_cast<std::size_t>(i)]) * (*J)(i, j);
    }
    return true;
  }

 private:
  bool is_large(double r) const { return robust_scale_ > 0.0 && std::abs(r) > robust_scale_; }
  /// Huber's loss as a square: 2 d |r| - d^2 beyond d. (Ceres would apply a loss to the whole block at once.)
  double robust(double r) const {
    const double d = robust_scale_;
    return is_large(r) ? std::copysign(std::sqrt(2.0 * d * std::abs(r) - d * d), r) : r;
  }
  double robust_slope(double r) const { return is_large(r) ? robust_scale_ / std::abs(robust(r)) : 1.0; }

  const ScaledModel& model_;
  double robust_scale_;
};

class Recorder : public ceres::IterationCallback {
 public:
  Recorder(const ScaledModel& model, const Eigen::VectorXd& u, const FitSettings& settings,
           std::vector<FitIteration>& path)
      : model_(model), u_(u), settings_(settings), path_(path) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.step_is_successful || summary.iteration == 0) {
      path_.push_back({model_.rms(summary.cost), model_.natural(u_)});
      if (settings_.iterated) settings_.iterated(path_.back());
    }
    // Before the first successful step Ceres 2.2 leaves the norm at zero.
    const bool was_tried = summary.iteration > 0 && summary.step_is_valid && summary.step_norm > 0.0;
    return was_tried && summary.step_norm < settings_.least_step ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                                 : ceres::SOLVER_CONTINUE;
  }

 private:
  const ScaledModel& model_;
  const Eigen::VectorXd& u_;
  const FitSettings& settings_;
  std::vector<FitIteration>& path_;
};

struct Attempt {
  Eigen::VectorXd u;
  double cost = std::numeric_limits<double>::infinity();
  bool converged = false;
  std::string message;
  std::vector<FitIteration> path;
};

ceres::Solver::Options options_of(const FitSettings& settings) {
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

void hold_at_bounds(const ScaledModel& model, const Eigen::VectorXd& u, std::vector<bool>& held) {
  const auto r = model.residuals(u);
  const auto J = model.jacobian(u);
  if (!r || !J) return;
  const Eigen::VectorXd gradient =
      J->transpose() * Eigen::Map<const Eigen::VectorXd>(r->data(), static_cast<Eigen::Index>(r->size()));
  for (std::size_t j = 0; j < held.size(); ++j) {
    const auto index = static_cast<Eigen::Index>(j);
    const int side = model.side_of_bound(j, u[index]);
    held[j] = side != 0 && side * gradient[index] < 0.0;
  }
}

/// The minimum from `u` on, with the parameters that are `held` as they are.
Attempt minimise(const ScaledModel& model, const Eigen::VectorXd& u, const std::vector<bool>& held,
                 const FitSettings& settings) {
  Attempt attempt;
  attempt.u = u;
  const auto at_start = model.residuals(u);
  if (!at_start) {
    attempt.message = "the model does not converge at the start";
    return attempt;
  }
  std::vector<double*> blocks;
  for (double& entry : attempt.u) blocks.push_back(&entry);
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(model, at_start->size(), settings.robust_scale), nullptr, blocks);
  for (std::size_t j = 0; j < blocks.size(); ++j) {
    const auto [lower, upper] = model.bounds(j);
    if (std::isfinite(lower)) problem.SetParameterLowerBound(blocks[j], 0, lower);
    if (std::isfinite(upper)) problem.SetParameterUpperBound(blocks[j], 0, upper);
    if (held[j]) problem.SetParameterBlockConstant(blocks[j]);
  }
  ceres::Solver::Options options = options_of(settings);
  Recorder recorder(model, attempt.u, settings, attempt.path);
  options.callbacks.push_back(&recorder);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  attempt.converged = summary.termination_type == ceres::CONVERGENCE || summary.termination_type == ceres::USER_SUCCESS;
  attempt.message = summary.termination_type == ceres::USER_SUCCESS
                        ? fmt::format("the last step was shorter than {:g}", settings.least_step)
                        : summary.message;
  if (summary.IsSolutionUsable()) attempt.cost = summary.final_cost;
  return attempt;
}

/// Ceres truncates steps at the bounds, which stalls where parameters are correlated. Parameters that have reached a
/// bound are therefore held there while the others continue, and released if the sum of squares decreases inwards.
Attempt minimise(const ScaledModel& model, const Eigen::VectorXd& start, const FitSettings& settings) {
  std::vector<bool> held(model.n_parameters(), false);
  Attempt attempt = minimise(model, start, held, settings);
  for (std::size_t turn = 0; turn < 2 * held.size() && std::isfinite(attempt.cost); ++turn) {
    const std::vector<bool> before = held;
    hold_at_bounds(model, attempt.u, held);
    if (held == before || std::ranges::count(held, false) == 0) break;
    Attempt next = minimise(model, attempt.u, held, settings);
    if (!(next.cost <= attempt.cost)) break;
    next.path.insert(next.path.begin(), attempt.path.begin(), attempt.path.end());
    attempt = std::move(next);
  }
  return attempt;
}

void check(const FitProblem& problem) {
  if (problem.parameters.empty()) throw InputError("there is no parameter to be estimated");
  for (const FitParameter& p : problem.parameters) {
    if (!(p.lower <= p.first && p.first <= p.upper) || !std::isfinite(p.first))
      throw InputError(fmt::format("parameter {}: the first guess {} is not within its bounds {} and {}", p.name,
                                   p.first, p.lower, p.upper));
    if (p.start && !(p.lower <= *p.start && *p.start <= p.upper))
      throw InputError(fmt::format("parameter {}: the start {} is not within its bounds {} and {}", p.name, *p.start,
                                   p.lower, p.upper));
    if (!(p.lower < p.upper))
      throw InputError(
          fmt::format("parameter {}: the lower bound {} is not below the upper one {}", p.name, p.lower, p.upper));
    if (p.log_scale && !(p.first > 0.0))
      throw InputError(
          fmt::format("parameter {}: on a logarithmic scale the first guess {} must be positive", p.name, p.first));
    if (p.prior && !problem.noise_is_known)
      throw InputError(fmt::format("parameter {}: a prior requires the noise of the data to be known", p.name));
    if (p.prior && !(p.prior->standard_deviation > 0.0))
      throw InputError(fmt::format("parameter {}: the standard deviation of its prior must be positive", p.name));
  }
}

}  // namespace

std::vector<double> FitResult::values() const {
  std::vector<double> result;
  for (const FitEstimate& estimate : estimates) result.push_back(estimate.value);
  return result;
}

FitResult fit(const FitProblem& problem, const FitSettings& settings) {
  check(problem);
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres would report every step at which the model fails
  ScaledModel model(problem, settings);
  FitResult result;
  Attempt best;
  const std::vector<Eigen::VectorXd> starts = starting_points(model, settings, result);
  model.prepare(starts);
  for (const Eigen::VectorXd& start : starts) {
    Attempt attempt = minimise(model, start, settings);
    result.start_rms.push_back(model.rms(attempt.cost));
    if (best.message.empty() || attempt.cost < best.cost) best = std::move(attempt);
  }
  if (!std::isfinite(best.cost)) throw ComputationError(fmt::format("the fit found no solution: {}", best.message));
  if (model.n_residuals() < model.n_parameters())
    throw InputError(fmt::format(
        "{} residuals cannot determine {} parameters; at least as many residuals as parameters are required",
        model.n_residuals(), model.n_parameters()));
  result.converged = best.converged;
  result.message = best.message;
  result.path = std::move(best.path);
  add_statistics(model, best.u, result);
  result.evaluations = model.evaluations();
  return result;
}

}  // namespace pfdm
