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
constexpr double chance_of_widening = 0.01;    // that noise alone widens the intervals
constexpr double inflation_to_widen = 1.1;     // by correlated residuals whose intervals are known
constexpr double least_visible = 0.3;          // of the variance of an estimate's error, in the residuals
constexpr double least_freedom = 3.0;          // residuals beyond the parameters that tell whether the model fits

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

/// Whether the residuals show how far the correlation of their noise moves each estimate.
bool correlation_is_resolved(const FitEvidence& evidence) {
  return !evidence.correlated.empty() && std::ranges::all_of(evidence.correlated, [](const CorrelatedError& error) {
    return error.visible >= least_visible;
  });
}

/// A reason for each series whose residuals are correlated: surely, or so that their intervals need be widened.
std::vector<std::string> correlated_series(const FitEvidence& evidence, bool surely) {
  std::vector<std::string> reasons;
  for (const ResidualSeries& series : evidence.series) {
    if (is_negligible(evidence, series.values)) continue;
    const Whiteness w = whiteness(series.values);
    const auto n = static_cast<double>(evidence.series.size());
    const bool is_sure = w.probability < false_alarm / n && w.inflation > noticeable_inflation;
    if (is_sure || (!surely && w.probability_of_sum < chance_of_widening / n && w.inflation > inflation_to_widen))
      reasons.push_back(
          fmt::format("the residuals of {} are correlated over {}: neighbours by {:.2f}, and intervals would be {:.1f} "
                      "times too narrow; an error of the model, or noise that is not independent",
                      series.name, series.along, w.neighbours, w.inflation));
  }
  return reasons;
}

std::string widening_text(const FitEvidence& evidence) {
  const double most = std::ranges::max(evidence.correlated, {}, &CorrelatedError::widening).widening;
  return fmt::format("standard errors are widened for the correlation, by up to {:.1f} times", most);
}

/// Of the whole fit.
std::size_t n_data_of(const FitEvidence& evidence) {
  std::size_t n = evidence.n_elsewhere;
  for (const ResidualSeries& series : evidence.series) n += series.values.size();
  return n;
}

/// Too few data to show whether the model is right.
void judge_number(const FitEvidence& evidence, std::vector<std::string>& reasons) {
  const std::size_t n = n_data_of(evidence);
  const std::size_t k = evidence.estimates.size();
  if (n > 0 && static_cast<double>(n) < static_cast<double>(k) + least_freedom)
    reasons.push_back(
        fmt::format("{} data for {} parameter{}: nothing shows whether the model fits; {} or more are needed", n, k,
                    k == 1 ? "" : "s", k + static_cast<std::size_t>(least_freedom)));
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
  const auto n = static_cast<double>(n_data_of(evidence));
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

/// That noise of n values gives as large a sum of its correlations at so many lags, by Bartlett's weights: normal.
double chance_of_sum(const std::vector<double>& correlation, std::size_t lags, std::size_t n) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 1; k <= lags; ++k) {
    const double weight = 1.0 - static_cast<double>(k) / static_cast<double>(lags + 1);
    sum += weight * correlation[k - 1];
    squares += weight * weight * static_cast<double>(n - k) / static_cast<double>(n);
  }
  return 0.5 * std::erfc(sum / std::sqrt(2.0 * squares / static_cast<double>(n)));
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::sound: return "sound";
    case Verdict::correlated: return "sound with correlated residuals";
    case Verdict::discretised: return "sound within the error of mesh and steps";
    case Verdict::questionable: return "questionable";
    case Verdict::failed: break;
  }
  return "failed";
}

Verdict verdict_named(std::string_view name) {
  for (const Verdict verdict :
       {Verdict::sound, Verdict::correlated, Verdict::discretised, Verdict::questionable, Verdict::failed})
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
  result.probability_of_sum =
      std::min(1.0, 2.0 * std::min(chance_of_sum(correlation, 1, n), chance_of_sum(correlation, lags, n)));
  return result;
}

std::vector<double> explained_by(const std::vector<double>& values, const std::vector<std::vector<double>>& columns) {
  std::vector<double> coefficients(columns.size(), 0.0);
  if (columns.empty() || values.size() < columns.size()) return coefficients;
  Eigen::MatrixXd A(std::ssize(values), std::ssize(columns));
  for (Eigen::Index j = 0; j < A.cols(); ++j) A.col(j) = Eigen::VectorXd::Map(columns[j].data(), A.rows());
  Eigen::VectorXd::Map(coefficients.data(), A.cols()) =
      scaled_least_squares(A, Eigen::VectorXd::Map(values.data(), A.rows()));
  return coefficients;
}

double rms_left_by(const std::vector<double>& values, const std::vector<std::vector<double>>& columns) {
  const std::vector<double> coefficients = explained_by(values, columns);
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double left = values[i];
    for (std::size_t j = 0; j < columns.size(); ++j) left -= coefficients[j] * columns[j][i];
    sum += left * left;
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
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
  const std::vector<std::string> correlated = correlated_series(evidence, !correlation_is_resolved(evidence));
  const bool model_error = reasons.size() > before || !correlated_series(evidence, true).empty();
  const std::size_t others = reasons.size();
  reasons.insert(reasons.end(), correlated.begin(), correlated.end());
  const std::size_t all = reasons.size();
  judge_number(evidence, reasons);
  judge_estimates(evidence.estimates, reasons);
  judge_starts(evidence, reasons);
  const bool only_correlated = others == 0 && reasons.size() == all && correlation_is_resolved(evidence);
  if (only_correlated && !correlated.empty()) reasons.push_back(widening_text(evidence));
  const Verdict verdict = failed            ? Verdict::failed
                          : reasons.empty() ? Verdict::sound
                          : only_correlated ? Verdict::correlated
                                            : Verdict::questionable;
  return {.verdict = verdict, .reasons = std::move(reasons), .model_error = model_error};
}

}  // namespace pfdm
