#include "cases/program/studies/fit/law_trial.h"

#include "physics/error.h"
#include "solver/calibration/calibration_verdict.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace pfdm {
namespace {

constexpr int iterations_of_trial = 6;

/// What a law would leave by the linear model about the estimates; infinite where its run does not converge.
double rms_by_linear_model(const FitProblem& problem, const FitResult& result) {
  const auto residuals = problem.residuals(result.values());
  if (!residuals) return std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> columns;
  for (Eigen::Index j = 0; j < result.derivatives.cols(); ++j)
    if (result.inverse_normal(j, j) > 0.0)
      columns.emplace_back(result.derivatives.col(j).begin(), result.derivatives.col(j).end());
  return rms_left_by(*residuals, columns);
}

/// Rms of what a law leaves; nothing where no run converges at the estimates.
std::optional<double> rms_of_fit(FitProblem problem, const FitResult& result, const FitSettings& settings) {
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) problem.parameters[j].start = result.estimates[j].value;
  try {
    return fit(problem, settings).rms;
  } catch (const NoConvergence&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<TriedLaw> best_other_law(const std::vector<CaseVariant>& laws, const FitResult& result,
                                       const std::function<FitProblem(const CaseFile&)>& problem_with,
                                       FitSettings settings, Log& log) {
  settings = on_grid(from_one_start(std::move(settings)));
  settings.maximum_iterations = iterations_of_trial;
  if (settings.differences == Differences::central) settings.differences = Differences::forward;
  settings.iterated = {};
  const CaseVariant* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const CaseVariant& law : laws)
    if (const double rms = rms_by_linear_model(problem_with(law.file), result); rms < least) least = rms, best = &law;
  if (best == nullptr) return std::nullopt;
  log.say(fmt::format("  all anew with {}", best->shown));
  const auto rms = rms_of_fit(problem_with(best->file), result, settings);
  return rms ? std::optional(TriedLaw{best->shown, *rms}) : std::nullopt;
}

}  // namespace pfdm
