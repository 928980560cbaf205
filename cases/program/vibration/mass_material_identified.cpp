#include "cases/program/vibration/mass_material_identified.h"

#include "physics/error.h"
#include "postproc/fits/fit_judgement.h"
#include "solver/vibration/diagnosis/identification_changes.h"
#include "solver/vibration/diagnosis/identification_faults.h"
#include "solver/vibration/identification/identification_evidence.h"
#include "solver/vibration/identification/identification_responses.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace pfdm {
namespace {

constexpr const char* not_converged = "the iteration did not converge; the estimates may be off";

/// The structures that the report's continuous-time least squares reaches: no kernel, or one term.
void require_low_order(const MassMaterialFit& fit, const ModelStructure& structure) {
  const int order = fit.kernel_order.value_or(structure.kernel_order.value_or(1));
  if (structure.forcing != KernelForcing::none && order != 1)
    throw InputError(
        fmt::format("[fit] \"least_squares\" supports kernels of one term; {} are requested: use \"output_error\" or "
                    "kernel_order = 1",
                    order));
}

/// Units of the values are also in their names.
std::vector<FittedParameter> fitted_parameters(const std::vector<Estimate>& estimates) {
  std::vector<FittedParameter> parameters;
  parameters.reserve(estimates.size());
  for (const Estimate& e : estimates)
    parameters.push_back({.name = e.name,
                          .unit = e.unit,
                          .estimate = e.value,
                          .standard_error = e.standard_error,
                          .lower = e.lower,
                          .upper = e.upper,
                          .lower_bound = e.lower_bound,
                          .upper_bound = e.upper_bound,
                          .at_bound = e.at_bound});
  return parameters;
}

/// What the regressions find: no intervals.
IdentifiedModel without_intervals(const Regression& regression, const MassMaterialRecords& records) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  IdentifiedModel found{.model = regression.model};
  std::vector<Estimate> estimates = named_values(found.model);
  FitIteration only{.rms = regression.misfit, .parameters = {}};
  for (Estimate& e : estimates) {
    e.lower = e.upper = e.standard_error = none;
    only.parameters.push_back(e.value);
  }
  found.report.found = {.converged = true,
                        .message = "solved without iterating on the simulated response",
                        .parameters = fitted_parameters(estimates),
                        .rms = regression.misfit,
                        .path = {only}};
  found.own.passivity = passivity_in_band(found.model, records.fitted);
  return found;
}

IdentifiedModel by_ten_steps(const MassMaterialRecords& records, const ModelStructure& structure,
                             const MassMaterialCase& c, Log&) {
  if (structure.forcing == KernelForcing::none)
    throw InputError(fmt::format("[fit] \"ten_step\" finds kernels; model \"{}\" has none", structure.name));
  const int order = c.fit.kernel_order.value_or(structure.kernel_order.value_or(2));
  TenSteps steps = ten_steps(records.fitted, structure, order, settings_of(c));
  IdentifiedModel found = without_intervals(steps.regression, records);
  found.ten_steps = std::move(steps);
  return found;
}

IdentifiedModel by_least_squares(const MassMaterialRecords& records, const ModelStructure& structure,
                                 const MassMaterialCase& c, Log&) {
  require_low_order(c.fit, structure);
  return without_intervals(regress_states(records.fitted, structure, settings_of(c)), records);
}

IdentifiedModel by_output_error(const MassMaterialRecords& records, const ModelStructure& structure,
                                const MassMaterialCase& c, Log& log) {
  Identification id = identify(records.fitted, structure, settings_of(c, &log));
  IdentifiedModel found{.model = id.fit.model, .report = {}, .own = {}, .doubts = id.fit.doubts, .bic = id.fit.bic};
  found.report.found = {.converged = id.fit.converged,
                        .message = id.fit.converged ? "the output error is least" : not_converged,
                        .parameters = fitted_parameters(id.fit.estimates),
                        .correlation = std::move(id.fit.correlation),
                        .n_residuals = id.fit.n_residuals,
                        .rms = id.fit.path.back().rms,
                        .first_rms = id.fit.path.front().rms,
                        .evaluations = id.fit.evaluations,
                        .path = std::move(id.fit.path)};
  const std::vector<Estimate> start = named_values(id.start.model);
  for (FittedParameter& p : found.report.found.parameters)
    if (const auto first = std::ranges::find(start, p.name, &Estimate::name); first != start.end())
      p.first_guess = first->value;
  found.own.orders = std::move(id.orders);
  found.own.passivity = id.passivity;
  return found;
}

std::vector<ExperimentMisfit> misfits(const MassMaterial& model, const MassMaterialRecords& records, double crop) {
  std::vector<ExperimentMisfit> tests;
  for (const auto& [all, fitted] : {std::pair(&records.fitted, true), std::pair(&records.predicted, false)})
    for (const VibrationRecord& r : *all)
      tests.push_back({.name = r.name,
                       .fitted = fitted,
                       .n_data = static_cast<std::size_t>(r.n()),
                       .relative = prediction_misfit(model, r, crop)});
  return tests;
}

/// What speaks against the model by the records, by its physics, and by the faults that would explain it.
std::vector<std::string> reasons_against(const IdentifiedModel& found, const MassMaterialRecords& records,
                                         const ModelStructure& structure, const MassMaterialCase& c) {
  std::vector<RecordEvidence> evidence;
  std::vector<double> misfit;
  std::vector<std::string> reasons;
  for (const VibrationRecord& record : records.fitted) {
    evidence.push_back(record_evidence(found.model, record, c.fit.crop));
    misfit.push_back(evidence.back().misfit);
    for (const std::string& fault : record.faults) reasons.push_back(fmt::format("test {}: {}", record.name, fault));
  }
  const auto add = [&reasons](const std::vector<std::string>& more) {
    reasons.insert(reasons.end(), more.begin(), more.end());
  };
  const std::vector<std::string> doubts = doubts_of(evidence);
  const bool unbounded = std::ranges::any_of(misfit, [](double m) { return !std::isfinite(m); });
  if (!doubts.empty() || unbounded) {
    const IdentificationSettings settings = settings_of(c);
    auto faults = recognised_faults(records.fitted, misfit, structure, settings);
    if (faults.empty() && !unbounded) faults = changes_of_sample(records.fitted, misfit, found.model, settings);
    add(faults);
  }
  add(doubts);
  add(traces_in(evidence));
  add(found.doubts);
  if (const Passivity& p = found.own.passivity; !p.passive)
    reasons.push_back(
        fmt::format("the model is not passive: it supplies energy to the shaker (damping {:.3g} N s/m at {:.4g} Hz)",
                    p.least_damping, p.worst_omega / (2.0 * std::numbers::pi)));
  return reasons;
}

/// With its verdict. A model that has no bounded response to a record that it was fitted to is no fit.
void judge(IdentifiedModel& found, const MassMaterialRecords& records, const ModelStructure& structure,
           const MassMaterialCase& c) {
  double misfit = 0.0;
  for (const ExperimentMisfit& test : found.report.experiments)
    if (test.fitted) misfit = std::max(misfit, test.relative);
  judge(found.report.found, {.misfit = misfit, .reasons = reasons_against(found, records, structure, c)});
}

/// The method's answer; where it has none, the faults of the records that may be why.
IdentifiedModel by_method(const MassMaterialRecords& records, const ModelStructure& structure,
                          const MassMaterialCase& c, Log& log) {
  const auto method = c.fit.method == "least_squares" ? by_least_squares
                      : c.fit.method == "ten_step"    ? by_ten_steps
                                                      : by_output_error;
  try {
    return method(records, structure, c, log);
  } catch (const ComputationError& error) {
    const std::vector<double> none(records.fitted.size(), std::numeric_limits<double>::infinity());
    const auto faults = recognised_faults(records.fitted, none, structure, settings_of(c));
    throw ComputationError(fmt::format("{}{}{}", error.what(), faults.empty() ? "" : "; ", fmt::join(faults, "; ")));
  }
}

}  // namespace

IdentificationSettings settings_of(const MassMaterialCase& c, Log* log) {
  IdentificationSettings settings{.mass = c.model.mass,
                                  .reference_velocity = c.model.reference_velocity,
                                  .kernel_order = c.fit.kernel_order,
                                  .maximum_kernel_order = c.fit.maximum_kernel_order,
                                  .crop = c.fit.crop,
                                  .replicates = c.fit.replicates,
                                  .confidence = c.fit.confidence,
                                  .seed = c.fit.seed};
  if (log != nullptr) settings.say = [log](const std::string& what) { log->say(what); };
  return settings;
}

IdentifiedModel identified(const MassMaterialRecords& records, const ModelStructure& structure,
                           const MassMaterialCase& c, Log& log) {
  IdentifiedModel found = by_method(records, structure, c, log);
  found.own.structure = structure.name;
  found.report.method = c.fit.method;
  found.report.confidence = c.fit.confidence;
  found.report.experiments = misfits(found.model, records, c.fit.crop);
  judge(found, records, structure, c);
  return found;
}

}  // namespace pfdm
