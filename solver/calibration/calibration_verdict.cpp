#include "solver/calibration/calibration_verdict.h"

#include "physics/error.h"
#include "solver/linear/dense_algebra.h"

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Of a whole fit: the chance that noise alone raises one of the two kinds of test.
constexpr double false_alarm = 0.002;
// What is significant in long records need not matter.
constexpr double no_fit = 0.9;                 // misfit over what was measured
constexpr double noticeable_excess = 1.1;      // of the residuals over the stated noise
constexpr double noticeable_inflation = 1.25;  // of the intervals, by correlated residuals

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// P(chi^2 > x).
double exceeded(double x, double freedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), x));
}

void judge_size(const FitEvidence& evidence, std::vector<std::string>& reasons) {
  double squares = 0.0, n = -static_cast<double>(evidence.estimates.size());
  for (const ResidualSeries& series : evidence.series) {
    squares += sum_of_squares(series.values);
    n += static_cast<double>(series.values.size());
  }
  if (!evidence.noise_is_known || !(n > 0.0)) return;
  const double ratio = std::sqrt(squares / n);
  if (ratio > noticeable_excess && exceeded(squares, n) < false_alarm)
    reasons.push_back(fmt::format("the residuals are {:.3g} times the stated noise", ratio));
}

/// Residuals that cannot move an estimate noticeably: of known noise less than one standard error in all.
bool is_negligible(const FitEvidence& evidence, const std::vector<double>& values) {
  const double squares = sum_of_squares(values);
  if (evidence.noise_is_known && squares < 1.0) return true;
  return squares <= evidence.negligible * evidence.negligible * static_cast<double>(values.size());
}

void judge_whiteness(const FitEvidence& evidence, std::vector<std::string>& reasons) {
  for (const ResidualSeries& series : evidence.series) {
    if (is_negligible(evidence, series.values)) continue;
    const Whiteness w = whiteness(series.values);
    const double allowed = false_alarm / static_cast<double>(evidence.series.size());
    if (w.probability < allowed && w.inflation > noticeable_inflation)
      reasons.push_back(
          fmt::format("the residuals of {} are correlated over {}: neighbours by {:.2f}, and intervals would be {:.1f} "
                      "times too narrow; an error of the model, or noise that is not independent",
                      series.name, series.along, w.neighbours, w.inflation));
  }
}

void judge_estimates(const std::vector<JudgedEstimate>& estimates, std::vector<std::string>& reasons) {
  for (const JudgedEstimate& e : estimates) {
    if (e.at_bound) {
      const bool upper = std::abs(e.value - e.upper_bound) < std::abs(e.value - e.lower_bound);
      reasons.push_back(fmt::format("{} is at its {} bound, {:.6g}", e.name, upper ? "upper" : "lower", e.value));
    } else if (std::isinf(e.standard_error)) {
      reasons.push_back(fmt::format("the data do not determine {}, by itself ({:.6g})", e.name, e.value));
    }
  }
}

/// Starts that end as low as the best one and elsewhere: as many standard errors away as the sum of squares does not
/// explain.
void judge_starts(const FitEvidence& evidence, std::vector<std::string>& reasons) {
  if (evidence.starts.size() < 2) return;
  double n = 0.0;
  for (const ResidualSeries& series : evidence.series) n += static_cast<double>(series.values.size());
  const double least = std::ranges::min(evidence.starts, {}, &FitIteration::rms).rms;
  const double freedom = n - static_cast<double>(evidence.estimates.size());
  const double variance = evidence.noise_is_known ? 1.0 : n * least * least / std::max(freedom, 1.0);
  for (const FitIteration& start : evidence.starts) {
    if (!(n * (start.rms * start.rms - least * least) < 4.0 * variance)) continue;
    for (std::size_t j = 0; j < std::min(evidence.estimates.size(), start.parameters.size()); ++j) {
      const JudgedEstimate& e = evidence.estimates[j];
      const double apart = std::abs(start.parameters[j] - e.value);
      if (!(apart > 4.0 * e.standard_error && apart > 1e-3 * std::abs(e.value))) continue;
      reasons.push_back(fmt::format(
          "starts that end equally well end at different estimates: {} at {:.6g} and {:.6g}, rms {:.6g} and {:.6g}",
          e.name, e.value, start.parameters[j], least, start.rms));
      return;
    }
  }
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::sound: return "sound";
    case Verdict::questionable: return "questionable";
    case Verdict::failed: break;
  }
  return "failed";
}

Verdict verdict_named(std::string_view name) {
  for (const Verdict verdict : {Verdict::sound, Verdict::questionable, Verdict::failed})
    if (name_of(verdict) == name) return verdict;
  throw InputError(fmt::format("\"{}\" is no verdict on a fit", name));
}

Whiteness whiteness(const std::vector<double>& values) {
  Whiteness result;
  const std::size_t n = values.size(), lags = std::min<std::size_t>(20, n / 8);
  const double squares = sum_of_squares(values);
  if (n < 16 || !(squares > 0.0) || !std::isfinite(squares)) return result;
  double portmanteau = 0.0;
  std::vector<double> correlation;
  for (std::size_t k = 1; k <= lags; ++k) {
    double product = 0.0;
    for (std::size_t i = k; i < n; ++i) product += values[i] * values[i - k];
    const double r = product / squares;
    if (k == 1) result.neighbours = r;
    portmanteau += r * r / static_cast<double>(n - k);
    correlation.push_back(r);
    double variance = 1.0;
    for (std::size_t i = 1; i <= k; ++i)
      variance += 2.0 * (1.0 - static_cast<double>(i) / static_cast<double>(k + 1)) * correlation[i - 1];
    result.inflation = std::max(result.inflation, std::sqrt(std::max(variance, 0.0)));
  }
  portmanteau *= static_cast<double>(n) * static_cast<double>(n + 2);
  result.probability = exceeded(portmanteau, static_cast<double>(lags));
  return result;
}

double rms_left_by(const std::vector<double>& values, const std::vector<std::vector<double>>& columns) {
  Eigen::VectorXd left = Eigen::VectorXd::Map(values.data(), std::ssize(values));
  Eigen::MatrixXd A(left.size(), std::ssize(columns));
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    A.col(j) = Eigen::VectorXd::Map(columns[static_cast<std::size_t>(j)].data(), left.size());
  if (A.cols() > 0 && A.rows() >= A.cols()) left -= A * scaled_least_squares(A, left);
  return left.norm() / std::sqrt(static_cast<double>(left.size()));
}

Judgement judge(const FitEvidence& evidence) {
  std::vector<std::string> reasons;
  if (!evidence.converged) reasons.push_back(fmt::format("the fit did not come to an end: {}", evidence.message));
  if (!std::isfinite(evidence.misfit))
    reasons.emplace_back("the model with these estimates has no bounded response");
  else if (evidence.misfit >= no_fit)
    reasons.push_back(fmt::format("the misfit is {:.3g} times what was measured", evidence.misfit));
  const bool failed = !reasons.empty();
  reasons.insert(reasons.end(), evidence.found.begin(), evidence.found.end());
  const std::size_t before = reasons.size();
  judge_size(evidence, reasons);
  judge_whiteness(evidence, reasons);
  const bool model_error = reasons.size() > before;
  judge_estimates(evidence.estimates, reasons);
  judge_starts(evidence, reasons);
  const Verdict verdict = failed ? Verdict::failed : reasons.empty() ? Verdict::sound : Verdict::questionable;
  return {.verdict = verdict, .reasons = std::move(reasons), .model_error = model_error};
}

}  // namespace pfdm
