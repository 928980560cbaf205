#include "cases/program/studies/interval_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double reach = 3.0;              // standard errors
constexpr double least_reach = 2.0;        // likewise, within the bounds; less is no trial
constexpr double share_that_holds = 0.25;  // of the expected growth of the sum of squares: half the stated width

double prior_term(const FitParameter& p, double value) {
  if (!p.prior) return 0.0;
  const double away = p.log_scale ? std::log(value / p.prior->mean) : value - p.prior->mean;
  return std::pow(away / p.prior->standard_deviation, 2);
}

/// As far from the estimate as the bounds leave, to the side that leaves more.
double place_of_trial(const FitParameter& p, const FitEstimate& estimate) {
  const double above = std::min(estimate.value + reach * estimate.standard_error, p.upper),
               below = std::max(estimate.value - reach * estimate.standard_error, p.lower);
  return above - estimate.value >= estimate.value - below ? above : below;
}

/// Where the linear model has the least residuals with parameter k moved to `value`.
double start_of(const DoneFit& done, std::size_t j, std::size_t k, double value) {
  const Eigen::MatrixXd& covariance = done.result.covariance;
  const auto row = static_cast<Eigen::Index>(j), column = static_cast<Eigen::Index>(k);
  const double from = done.result.estimates[k].value, estimate = done.result.estimates[j].value;
  const double away = done.problem.parameters[k].log_scale ? std::log(value / from) : value - from;
  const double move = away * covariance(row, column) / covariance(column, column);
  const FitParameter& p = done.problem.parameters[j];
  const double start = p.log_scale ? estimate * std::exp(move) : estimate + move;
  return std::clamp(std::isfinite(start) ? start : estimate, p.lower, p.upper);
}

/// The problem of the other parameters.
FitProblem without(const DoneFit& done, std::size_t k, double value) {
  const FitProblem& problem = done.problem;
  const auto all = [k, value](std::span<const double> others) {
    std::vector<double> values(others.begin(), others.end());
    values.insert(values.begin() + static_cast<std::ptrdiff_t>(k), value);
    return values;
  };
  FitProblem rest = problem;
  for (std::size_t j = 0; j < rest.parameters.size(); ++j) rest.parameters[j].start = start_of(done, j, k, value);
  rest.parameters.erase(rest.parameters.begin() + static_cast<std::ptrdiff_t>(k));
  rest.residuals = [&problem, all](std::span<const double> others) { return problem.residuals(all(others)); };
  rest.prepare = [&problem, all](const std::vector<std::vector<double>>& points) {
    std::vector<std::vector<double>> whole;
    whole.reserve(points.size());
    for (const std::vector<double>& point : points) whole.push_back(all(point));
    problem.prepare(whole);
  };
  return rest;
}

/// Growth of the sum of squares, priors included.
double growth(const DoneFit& done, std::size_t k, double there, const FitResult& other) {
  const FitParameter& p = done.problem.parameters[k];
  return static_cast<double>(done.result.residuals.size()) *
             (std::pow(other.path.back().rms, 2) - std::pow(done.result.path.back().rms, 2)) +
         prior_term(p, there) - prior_term(p, done.result.estimates[k].value);
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
  const double there = place_of_trial(done.problem.parameters[k], estimate);
  log.say(
      fmt::format("  the others anew with {} = {}", done.parameters[k].short_name(), done.parameters[k].shown(there)));
  FitSettings once = done.settings;
  once.starts = 1;
  once.screened = 0;
  const FitResult other = fit(without(done, k, there), once);
  const double n = static_cast<double>(done.result.residuals.size()),
               freedom = n - static_cast<double>(done.parameters.size());
  const double variance = done.problem.noise_is_known ? 1.0 : done.result.sum_of_squares / freedom;
  const double away = std::abs(there - estimate.value) / error;
  if (away >= least_reach && growth(done, k, there, other) > share_that_holds * away * away * variance)
    return std::nullopt;
  return not_told_apart(done, k, there, other);
}

}  // namespace pfdm
