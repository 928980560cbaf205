#include "solver/calibration/calibration.h"

#include "physics/error.h"
#include "solver/calibration/calibration_scale.h"
#include "solver/calibration/calibration_starts.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/calibration/levenberg_marquardt.h"
#include "solver/linear/dense_algebra.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pfdm {
namespace {

/// Residuals and priors as functions of the scaled parameters.
using JacobianOf = std::optional<Eigen::MatrixXd> (ScaledModel::*)(const Eigen::VectorXd&) const;

LeastSquaresProblem problem_of(const ScaledModel& model, JacobianOf jacobian = &ScaledModel::jacobian) {
  LeastSquaresProblem problem{
      .residuals = [&](const Eigen::VectorXd& u) -> std::optional<Eigen::VectorXd> {
        const auto r = model.residuals(u);
        if (!r) return std::nullopt;
        return Eigen::VectorXd::Map(r->data(), std::ssize(*r));
      },
      .jacobian = [&model, jacobian](const Eigen::VectorXd& u) { return (model.*jacobian)(u); }};
  for (std::size_t j = 0; j < model.n_parameters(); ++j) problem.bounds.push_back(model.bounds(j));
  return problem;
}

FitIteration iteration_of(const ScaledModel& model, const LeastSquaresPoint& point) {
  return {model.rms(point.cost), model.natural(point.x)};
}

LeastSquaresSettings settings_of(const ScaledModel& model, const FitSettings& settings) {
  LeastSquaresSettings result{.maximum_iterations = settings.maximum_iterations,
                              .tolerance = settings.tolerance,
                              .cost_tolerance = settings.cost_tolerance,
                              .least_step = settings.least_step,
                              .trust_radius = settings.trust_radius,
                              .robust_scale = settings.robust_scale};
  if (settings.iterated)
    result.iterated = [&](const LeastSquaresPoint& point) { settings.iterated(iteration_of(model, point)); };
  return result;
}

/// What the linear model about x still takes from the sum of squares, relative, by parameters that are not at a bound.
double promised_gain(const ScaledModel& model, const Eigen::VectorXd& x) {
  const auto r = model.residuals(x);
  auto J = model.jacobian_about(x);
  if (!r || !J || J->rows() < J->cols()) return 0.0;
  for (std::size_t j = 0; j < model.n_parameters(); ++j)
    if (side_of_bound(x[static_cast<Eigen::Index>(j)], model.bounds(j)) != 0)
      J->col(static_cast<Eigen::Index>(j)).setZero();
  const Eigen::Map<const Eigen::VectorXd> residuals(r->data(), std::ssize(*r));
  return (*J * scaled_least_squares(*J, residuals)).squaredNorm() / residuals.squaredNorm();
}

/// On from where shared differences have led, by those about the points themselves.
void refine(const ScaledModel& model, const FitSettings& settings, LeastSquaresResult& best) {
  if (!(promised_gain(model, best.x) > settings.cost_tolerance)) return;
  LeastSquaresSettings further = settings_of(model, settings);
  if (further.iterated)
    further.iterated = [tell = further.iterated, is_known = true](const LeastSquaresPoint& point) mutable {
      if (!std::exchange(is_known, false)) tell(point);
    };
  LeastSquaresResult next = minimise(problem_of(model, &ScaledModel::jacobian_about), best.x, further);
  if (!(next.cost < best.cost)) return;
  if (!best.path.empty()) next.path.erase(next.path.begin());  // where the other one ends
  next.path.insert(next.path.begin(), best.path.begin(), best.path.end());
  best = std::move(next);
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

void set_limits(std::vector<FitParameter>& parameters, const std::vector<FitParameter>& limits) {
  for (FitParameter& p : parameters)
    for (const FitParameter& limit : limits)
      if (limit.name == p.name) {
        p.lower = limit.lower;
        p.upper = limit.upper;
        p.prior = limit.prior;
        p.first = std::clamp(p.first, p.lower, p.upper);
      }
}

std::vector<double> FitResult::values() const {
  std::vector<double> result;
  for (const FitEstimate& estimate : estimates) result.push_back(estimate.value);
  return result;
}

FitResult fit(const FitProblem& problem, const FitSettings& settings) {
  check(problem);
  ScaledModel model(problem, settings);
  FitResult result;
  LeastSquaresResult best;
  std::size_t best_start = 0;
  const std::vector<Eigen::VectorXd> starts = starting_points(model, settings, result);
  model.prepare(starts);
  for (const Eigen::VectorXd& start : starts) {
    LeastSquaresResult found = minimise(problem_of(model), start, settings_of(model, settings));
    result.starts.push_back(iteration_of(model, {found.x, found.cost}));
    if (!best.message.empty() && !(found.cost < best.cost)) continue;
    best = std::move(found);
    best_start = result.starts.size() - 1;
  }
  if (!std::isfinite(best.cost)) throw NoConvergence(fmt::format("the fit found no solution: {}", best.message));
  if (model.n_residuals() < model.n_parameters())
    throw InputError(fmt::format(
        "{} residuals cannot determine {} parameters; at least as many residuals as parameters are required",
        model.n_residuals(), model.n_parameters()));
  if (settings.differences == Differences::shared && !settings.ends_on_grid) refine(model, settings, best);
  result.starts[best_start] = iteration_of(model, {best.x, best.cost});
  result.noise_is_known = problem.noise_is_known;
  result.converged = best.converged;
  result.message = best.message;
  for (const LeastSquaresPoint& point : best.path) result.path.push_back(iteration_of(model, point));
  add_statistics(model, best.x, result);
  result.evaluations = model.evaluations();
  return result;
}

}  // namespace pfdm
