#include "postproc/fits/fit_judgement.h"

#include "physics/quantity_text.h"
#include "solver/calibration/calibration_statistics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double noticeable_move = 0.3;  // by a finer discretisation, of the standard error
constexpr double most_of_move = 4.0;     // of what a finer discretisation does to residuals, and the exact model would

std::vector<CorrelatedError> errors_if_correlated(const JudgedData& data) {
  if (data.result == nullptr || !data.correlated_is_noise || data.result->inverse_normal.size() == 0) return {};
  std::vector<std::size_t> lengths;
  std::size_t rest = data.result->residuals.size();  // of fields, which count as independent data
  for (const ResidualSeries& series : data.series) {
    lengths.push_back(series.values.size());
    rest -= std::min(rest, series.values.size());
  }
  lengths.insert(lengths.end(), rest, 1);
  return correlated_errors(*data.result, lengths);
}

FitEvidence evidence_of(const FitFindings& found, const JudgedData& data) {
  FitEvidence evidence{.converged = found.converged,
                       .message = found.message,
                       .misfit = data.misfit,
                       .series = data.series,
                       .n_elsewhere = data.n_elsewhere,
                       .noise_is_known = found.noise_is_known,
                       .negligible = data.negligible,
                       .correlated = errors_if_correlated(data),
                       .starts = found.starts,
                       .found = data.reasons};
  for (const FittedParameter& p : found.parameters)
    evidence.estimates.push_back({.name = p.name,
                                  .value = p.estimate,
                                  .standard_error = p.standard_error,
                                  .lower_bound = p.lower_bound,
                                  .upper_bound = p.upper_bound,
                                  .at_bound = p.at_bound});
  return evidence;
}

Eigen::VectorXd change_by_finer(const JudgedData& data) {
  const auto as_vector = [](const std::vector<double>& v) { return Eigen::VectorXd::Map(v.data(), std::ssize(v)); };
  return as_vector(data.finer->residuals) - as_vector(data.result->residuals);
}

/// The data with what a finer discretisation and other estimates explain taken from the residuals; nothing where it is
/// not in the direction of the finer one, or more than the discretisation's error can be.
std::optional<FitResult> without_error_of_discretisation(const JudgedData& data) {
  const FitResult& result = *data.result;
  const Eigen::VectorXd change = change_by_finer(data);
  std::vector<std::vector<double>> columns{{change.begin(), change.end()}};
  for (Eigen::Index j = 0; j < result.derivatives.cols(); ++j)
    if (result.inverse_normal(j, j) > 0.0)
      columns.emplace_back(result.derivatives.col(j).begin(), result.derivatives.col(j).end());
  const std::vector<double> coefficients = explained_by(result.residuals, columns);
  // The exact model would leave residuals + f * change with f > 0.
  if (!(-coefficients[0] > 0.0 && -coefficients[0] < most_of_move)) return std::nullopt;
  FitResult left = result;
  for (std::size_t i = 0; i < left.residuals.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) left.residuals[i] -= coefficients[j] * columns[j][i];
  return left;
}

/// The evidence once the error of the discretisation is taken out.
std::optional<FitEvidence> evidence_without_discretisation(const FitFindings& found, JudgedData data) {
  const auto left = without_error_of_discretisation(data);
  if (!left) return std::nullopt;
  auto next = left->residuals.begin();
  for (ResidualSeries& series : data.series) {
    const auto end = next + std::ssize(series.values);
    series.values.assign(next, end);
    next = end;
  }
  data.result = &*left;
  return evidence_of(found, data);
}

/// With a prefix where people write one: of stresses, lengths, forces and energies.
std::string with_unit(double si, const std::string& unit) {
  const std::string first = unit.substr(0, unit.find_first_of("/^ "));
  if (first == "Pa" || first == "m" || first == "N" || first == "J") return quantity_text(si, unit);
  return unit.empty() || unit == "1" ? fmt::format("{:.4g}", si) : fmt::format("{:.4g} {}", si, unit);
}

Eigen::VectorXd moves_by_finer(const JudgedData& data) {
  return -data.result->inverse_normal * (data.result->derivatives.transpose() * change_by_finer(data));
}

/// What the interval reaches on the side of the finer discretisation, of noise alone.
double reach_towards_finer(const FittedParameter& p) {
  return p.moved_by_finer < 0.0 ? p.estimate - p.lower : p.upper - p.estimate;
}

/// One line of all moves that are noticeable: a warning, or a reason where one is larger than the interval of the
/// noise.
void tell_moves(FitFindings& found) {
  std::vector<std::string> moved, larger;
  for (const FittedParameter& p : found.parameters) {
    const double errors = std::abs(p.moved_by_finer) / p.standard_error;
    if (!(errors > noticeable_move)) continue;
    moved.push_back(fmt::format("{} would be {} ({:+.2g} %, {:.2g} standard errors)", p.name,
                                with_unit(p.estimate + p.moved_by_finer, p.unit), 100.0 * p.moved_by_finer / p.estimate,
                                errors));
    if (std::abs(p.moved_by_finer) > reach_towards_finer(p)) larger.push_back(p.name);
  }
  if (moved.empty()) return;
  const std::string told = fmt::format("with {} {}", found.finer, fmt::join(moved, ", "));
  if (!is_sound(found.verdict) || larger.empty()) {
    found.warnings.push_back(told);
    return;
  }
  found.verdict = Verdict::discretised;
  found.reasons.push_back(
      fmt::format("{}: more than what the noise leaves open of {}. With a mesh or steps as fine as those in the case "
                  "itself it is less",
                  told, fmt::join(larger, ", ")));
}

void add_moves(FitFindings& found, const JudgedData& data) {
  const Eigen::VectorXd moves = moves_by_finer(data);
  found.finer = data.finer->what;
  for (std::size_t j = 0; j < found.parameters.size(); ++j) {
    FittedParameter& p = found.parameters[j];
    const double move = moves[j];
    p.moved_by_finer = p.log_scale ? p.estimate * std::expm1(move) : move;
  }
  tell_moves(found);
  for (FittedParameter& p : found.parameters) hold_move(p, p.lower, p.upper);
}

}  // namespace

void widen(FittedParameter& p, double by, double freedom) {
  p.widened_by = by;
  p.freedom = freedom;
  p.standard_error *= by;
  const double reach = student_95(std::min(freedom, 1e9)) * p.standard_error;
  p.lower = p.log_scale ? p.estimate * std::exp(-reach / p.estimate) : p.estimate - reach;
  p.upper = p.log_scale ? p.estimate * std::exp(reach / p.estimate) : p.estimate + reach;
}

std::optional<double> reach_of_widened(const FittedParameter& p) {
  if (p.widened_by == 1.0 && std::isinf(p.freedom)) return std::nullopt;
  return p.widened_by * student_95(std::min(p.freedom, 1e9));
}

void hold_move(const FittedParameter& p, double& lower, double& upper) {
  if (!std::isfinite(p.moved_by_finer)) return;
  const double factor = 1.0 + p.moved_by_finer / p.estimate;
  const double down = p.log_scale ? lower * std::min(1.0, factor) : lower + std::min(0.0, p.moved_by_finer);
  const double up = p.log_scale ? upper * std::max(1.0, factor) : upper + std::max(0.0, p.moved_by_finer);
  lower = std::max(down, std::min(lower, p.lower_bound));
  upper = std::min(up, std::max(upper, p.upper_bound));
}

bool judge(FitFindings& found, JudgedData data) {
  FitEvidence evidence = evidence_of(found, data);
  Judgement judgement = judge(evidence);
  if (data.finer && data.result != nullptr) {
    if (judgement.model_error)
      if (auto other = evidence_without_discretisation(found, data)) {
        if (Judgement better = judge(*other); !better.model_error || better.verdict < judgement.verdict) {
          judgement = std::move(better);
          evidence = std::move(*other);
          found.warnings.push_back(
              fmt::format("the residuals hold the error of the discretisation: {} takes it out", data.finer->what));
        }
      }
  }
  found.verdict = judgement.verdict;
  found.reasons = std::move(judgement.reasons);
  found.converged = found.converged && found.verdict != Verdict::failed;
  if (found.verdict == Verdict::correlated)
    for (std::size_t j = 0; j < evidence.correlated.size(); ++j)
      widen(found.parameters[j], evidence.correlated[j].widening, evidence.correlated[j].freedom);
  if (data.finer && data.result != nullptr) add_moves(found, data);
  if (!is_sound(found.verdict)) withhold_intervals(found);
  return judgement.model_error;
}

void question(FitFindings& found, std::string reason) {
  found.reasons.push_back(std::move(reason));
  found.verdict = std::max(found.verdict, Verdict::questionable);
  withhold_intervals(found);
}

void withhold_intervals(FitFindings& found) {
  const bool holds_discrepancy = found.posterior && found.posterior->discrepancy;
  if (!holds_discrepancy) found.posterior.reset();
  for (FittedParameter& p : found.parameters) {
    p.standard_error = p.lower = p.upper = std::numeric_limits<double>::quiet_NaN();
    p.widened_by = 1.0;
    p.freedom = std::numeric_limits<double>::infinity();
    p.profile.reset();
    if (!holds_discrepancy) p.posterior.reset();
  }
}

}  // namespace pfdm
