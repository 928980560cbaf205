#include "cases/program/studies/fit/interval_trial.h"

#include "solver/calibration/held_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double reach = 3.0;              // standard errors
constexpr double least_reach = 2.0;        // likewise, within the bounds of all; less is no trial
constexpr double share_that_holds = 0.25;  // of the expected growth of the sum of squares: half the stated width

/// Another parameter that, by the linear model, has met a bound with parameter k at this value. There the residuals
/// grow because of the bound, not because of the data.
std::optional<std::size_t> at_its_bound(const DoneFit& done, std::size_t k, double value) {
  const std::vector<double> others = others_by_linear_model(done.problem, done.result, k, value);
  for (std::size_t j = 0; j < done.parameters.size(); ++j) {
    if (j == k || done.result.estimates[j].at_bound) continue;
    const FitParameter& p = done.problem.parameters[j];
    const double there = others[j < k ? j : j - 1];
    if (there <= p.lower || there >= p.upper) return j;
  }
  return std::nullopt;
}

/// As far from the estimate as its own bounds leave, to the side that leaves more; nearer, or to the other side, where
/// another parameter meets a bound first.
double place_of_trial(const DoneFit& done, std::size_t k) {
  const FitParameter& p = done.problem.parameters[k];
  const FitEstimate& estimate = done.result.estimates[k];
  const auto within = [&](double away) {
    return std::clamp(estimate.value + away * estimate.standard_error, p.lower, p.upper);
  };
  const double side = within(reach) - estimate.value >= estimate.value - within(-reach) ? 1.0 : -1.0;
  for (const double away : {reach, 0.5 * (reach + least_reach)})
    for (const double there : {within(side * away), within(-side * away)})
      if (std::abs(there - estimate.value) >= least_reach * estimate.standard_error && !at_its_bound(done, k, there))
        return there;
  return within(side * reach);
}

/// From where the linear model has them, or from the estimates. Nothing if the model converges at neither.
std::optional<FitResult> others_anew(const DoneFit& done, std::size_t k, double there, const FitSettings& settings) {
  std::vector<double> at_estimates = done.result.values();
  at_estimates.erase(at_estimates.begin() + k);
  for (const auto& others : {others_by_linear_model(done.problem, done.result, k, there), at_estimates}) {
    const FitProblem held = with_held(done.problem, k, there, others);
    std::vector<double> start;
    for (const FitParameter& p : held.parameters) start.push_back(*p.start);
    if (held.residuals(start)) return fit(held, settings);
  }
  return std::nullopt;
}

std::string not_told_apart(const DoneFit& done, std::size_t k, double there, const FitResult& other) {
  const std::vector<FitEstimate>& estimates = done.result.estimates;
  const auto elsewhere = [&](std::size_t j) { return other.estimates[j < k ? j : j - 1].value; };
  std::size_t twin = k == 0 ? 1 : 0;
  const auto moved = [&](std::size_t j) {
    return std::abs(elsewhere(j) - estimates[j].value) / estimates[j].standard_error;
  };
  for (std::size_t j = 0; j < estimates.size(); ++j)
    if (j != k && moved(j) > moved(twin)) twin = j;
  const CaseParameter &own = done.parameters[k], &like = done.parameters[twin];
  return fmt::format(
      "the data do not tell {} and {} apart: with {} and {} the rms of the residuals is {:.4g}, with {} "
      "and {} it is {:.4g}; give one of them",
      like.name, own.name, like.shown(estimates[twin].value), own.shown(estimates[k].value), done.result.rms,
      like.shown(elsewhere(twin)), own.shown(there), other.rms);
}

}  // namespace

std::optional<std::string> doubt_of_interval(const DoneFit& done, std::size_t k, Log& log) {
  const FitEstimate& estimate = done.result.estimates[k];
  const double error = estimate.standard_error;
  if (done.parameters.size() < 2 || !(error > 0.0) || !std::isfinite(error)) return std::nullopt;
  const double there = place_of_trial(done, k);
  const double away = std::abs(there - estimate.value) / error;
  if (const auto other = at_its_bound(done, k, there))
    return fmt::format(
        "the interval of {} could not be tried: with {} {} is at its bound; widen that, or give one of the two",
        done.parameters[k].name, done.parameters[k].shown(there), done.parameters[*other].name);
  log.say(
      fmt::format("  the others anew with {} = {}", done.parameters[k].short_name(), done.parameters[k].shown(there)));
  FitSettings once = on_grid(from_one_start(done.settings));
  if (done.settings.iterated)
    once.iterated = [&](FitIteration iteration) {  // of the others: told with the held one in its place
      iteration.parameters.insert(iteration.parameters.begin() + k, there);
      done.settings.iterated(iteration);
    };
  const std::optional<FitResult> other = others_anew(done, k, there, once);
  if (!other)
    return fmt::format("the interval of {} could not be tried: the model does not converge with {}",
                       done.parameters[k].name, done.parameters[k].shown(there));
  const double n = static_cast<double>(done.result.residuals.size()),
               freedom = n - static_cast<double>(done.parameters.size());
  const double variance = done.problem.noise_is_known ? 1.0 : done.result.sum_of_squares / freedom;
  if (away >= least_reach &&
      growth_of_squares(done.problem, done.result, k, there, *other) > share_that_holds * away * away * variance)
    return std::nullopt;
  return not_told_apart(done, k, there, *other);
}

}  // namespace pfdm
