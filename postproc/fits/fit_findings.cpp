#include "postproc/fits/fit_findings.h"

#include <algorithm>
#include <utility>

namespace pfdm {

FitFindings findings_of(const std::vector<FitParameter>& parameters, const FitResult& result) {
  FitFindings found{.converged = result.converged,
                    .message = result.message,
                    .parameters = {},
                    .correlation = result.correlation,
                    .n_residuals = result.residuals.size(),
                    .rms = result.rms,
                    .noise_is_known = result.noise_is_known,
                    .evaluations = result.evaluations,
                    .warnings = result.warnings,
                    .starts = result.starts,
                    .path = result.path,
                    .screened = result.screened};
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const FitParameter& p = parameters[j];
    const FitEstimate& e = result.estimates[j];
    found.parameters.push_back({.name = p.name,
                                .unit = p.unit,
                                .estimate = e.value,
                                .standard_error = e.standard_error,
                                .lower = e.lower_95,
                                .upper = e.upper_95,
                                .first_guess = p.first,
                                .lower_bound = p.lower,
                                .upper_bound = p.upper,
                                .at_bound = e.at_bound,
                                .log_scale = p.log_scale});
  }
  return found;
}

ExperimentMisfit experiment_misfit(std::string name, std::size_t n_data, const ExperimentMisfit::Absolute& absolute,
                                   std::string curve) {
  return {.name = std::move(name),
          .n_data = n_data,
          .relative = absolute.rms / absolute.rms_measured,
          .absolute = absolute,
          .curve = std::move(curve)};
}

double FittedEvent::figure(const std::string& wanted, double Figure::*value) const {
  const auto found = std::ranges::find(figures, wanted, &Figure::name);
  return found != figures.end() ? *found.*value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace pfdm
