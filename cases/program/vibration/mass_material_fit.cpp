// fit_mass_material() of mass_material_jobs.h.

#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/stopwatch.h"
#include "cases/program/vibration/mass_material_jobs.h"
#include "postproc/curves/fit_json.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "solver/vibration/identification.h"
#include "solver/vibration/identification_evidence.h"
#include "solver/vibration/identification_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr const char* not_converged = "the iteration did not converge; the estimates may be off";

struct Records {
  std::vector<VibrationRecord> fitted;
  std::vector<VibrationRecord> predicted;
};

Records read_records(const MassMaterialCase& c, const fs::path& results, Log& log) {
  Records records;
  for (const VibrationTest& test : c.tests)
    (test.predicted ? records.predicted : records.fitted).push_back(record_of(test, results, log));
  if (records.fitted.empty()) throw InputError("every test is predicted; at least one has to be fitted");
  return records;
}

IdentificationSettings settings_of(const MassMaterialCase& c, Log* log = nullptr) {
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

/// The structures that the report's continuous-time least squares reaches: no kernel, or one term.
void require_low_order(const MassMaterialFit& fit, const ModelStructure& structure) {
  const int order = fit.kernel_order.value_or(structure.kernel_order.value_or(1));
  if (structure.forcing != KernelForcing::none && order != 1)
    throw InputError(
        fmt::format("[fit] \"least_squares\" supports kernels of one term; {} are requested: use \"output_error\" or "
                    "kernel_order = 1",
                    order));
}

/// Found model and what is told about it.
struct Found {
  MassMaterial model;
  FitReport report{};
  VibrationFindings own{};
  std::vector<std::string> doubts{};  ///< of the method itself
};

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
Found without_intervals(const Regression& regression, const Records& records) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Found found{.model = regression.model};
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

Found by_ten_steps(const Records& records, const ModelStructure& structure, const MassMaterialCase& c, Log&) {
  if (structure.forcing == KernelForcing::none)
    throw InputError(fmt::format("[fit] \"ten_step\" finds kernels; model \"{}\" has none", structure.name));
  const int order = c.fit.kernel_order.value_or(structure.kernel_order.value_or(2));
  return without_intervals(regress_ten_steps(records.fitted, structure, order, settings_of(c)), records);
}

Found by_least_squares(const Records& records, const ModelStructure& structure, const MassMaterialCase& c, Log&) {
  require_low_order(c.fit, structure);
  return without_intervals(regress_states(records.fitted, structure, settings_of(c)), records);
}

Found by_output_error(const Records& records, const ModelStructure& structure, const MassMaterialCase& c, Log& log) {
  Identification id = identify(records.fitted, structure, settings_of(c, &log));
  Found found{.model = id.fit.model, .report = {}, .own = {}, .doubts = id.fit.doubts};
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

std::vector<ExperimentMisfit> misfits(const MassMaterial& model, const Records& records, double crop) {
  std::vector<ExperimentMisfit> tests;
  for (const auto& [all, fitted] : {std::pair(&records.fitted, true), std::pair(&records.predicted, false)})
    for (const VibrationRecord& r : *all)
      tests.push_back({.name = r.name,
                       .fitted = fitted,
                       .n_data = static_cast<std::size_t>(r.n()),
                       .relative = prediction_misfit(model, r, crop)});
  return tests;
}

/// E' + j E'' = K L/A: the sample as a bar in uniaxial stress, whose own inertia counts as a third of its mass in m.
std::vector<ModulusRow> youngs_modulus(const MassMaterial& model, const Records& records, const SampleSize& sample) {
  const auto [low, high, velocity, displacement] = excited_range(records.fitted);
  std::vector<ModulusRow> rows;
  constexpr int n = 25;
  for (int i = 0; i < n; ++i) {
    const double f = low * std::pow(high / low, static_cast<double>(i) / (n - 1));
    const auto E = complex_stiffness(model, 2.0 * std::numbers::pi * f, velocity) * (sample.length / sample.area);
    rows.push_back({f, E.real(), E.imag()});
  }
  return rows;
}

/// Of the stiffness polynomial, as far as the fitted records went.
OgdenFit ogden_of(const MassMaterial& model, const Records& records, const MassMaterialCase& c) {
  return fit_ogden(model.stiffness, c.sample->length, c.sample->area, excited_range(records.fitted).displacement,
                   c.fit.ogden_terms);
}

void say_ogden(const OgdenFit& ogden, Log& log) {
  log.say(fmt::format("Ogden's model of k(z) up to {:.4g} m: shear modulus {:.6g} Pa, misfit {:.3g} of the force",
                      ogden.largest_displacement, shear_modulus(ogden.terms), ogden.relative_misfit));
  for (const OgdenTerm& term : ogden.terms)
    log.say(fmt::format("  mu {:>14.6g} Pa, alpha {:.6g}", term.mu, term.alpha));
}

/// In per cent of the mean.
std::string with_interval(const Effect& e, double mean) {
  const double percent = 100.0 / std::abs(mean);
  return fmt::format("{} {:+.3g} % ({:+.3g} to {:+.3g})", e.name, percent * e.value, percent * e.lower_95,
                     percent * e.upper_95);
}

void say_repeats(const RepeatedIdentification& repeats, Log& log) {
  log.say(fmt::format("repeatability over {} records, each fitted on its own; in % of the mean, 95 % intervals:",
                      repeats.records.size()));
  for (const ParameterRepeatability& p : repeats.parameters) {
    const Repeatability& r = p.statistics;
    const double percent = 100.0 / std::abs(r.mean);
    log.say(fmt::format("  {:<18} mean {:>12.6g}, between repeats {} (noise alone {:.3g} %), about the line {:.3g} %",
                        p.name, r.mean,
                        r.repeat_deviation ? fmt::format("{:.3g} %", percent * *r.repeat_deviation) : "-",
                        percent * p.expected_deviation, percent * r.residual_deviation));
    for (const Effect& e : r.effects) log.say(fmt::format("  {:<18}   {}", "", with_interval(e, r.mean)));
  }
  for (const RecordEstimates& r : repeats.records)
    if (!r.converged) log.warn(fmt::format("test {}: its own fit did not converge", r.name));
}

RepeatedIdentification repeats_of(const Found& found, const Records& records, const MassMaterialCase& c) {
  std::vector<ScheduledRun> schedule;
  for (const VibrationTest& test : c.tests)
    if (!test.predicted) schedule.push_back(*test.schedule);
  return identify_each(records.fitted, schedule, found.model, settings_of(c));
}

void say_found(const Found& found, Log& log) {
  for (const FittedParameter& p : found.report.found.parameters)
    log.say(fmt::format("  {:<18} {:>14.6g}   {}", p.name, p.estimate,
                        interval_text(p.lower, p.upper, found.report.confidence)));
  for (const ExperimentMisfit& test : found.report.experiments)
    log.say(fmt::format("  test {:<16} {}, relative misfit {:.3g}", test.name, test.fitted ? "fitted" : "predicted",
                        test.relative));
  if (found.own.ogden) say_ogden(*found.own.ogden, log);
  if (found.own.repeats) say_repeats(*found.own.repeats, log);
}

/// What speaks against the model by the records, by its physics, and by the faults that would explain it.
std::vector<std::string> reasons_against(const Found& found, const Records& records, const ModelStructure& structure,
                                         const MassMaterialCase& c) {
  std::vector<RecordEvidence> evidence;
  std::vector<double> misfit;
  for (const VibrationRecord& record : records.fitted) {
    evidence.push_back(record_evidence(found.model, record, c.fit.crop));
    misfit.push_back(evidence.back().misfit);
  }
  std::vector<std::string> reasons = doubts_of(evidence);
  const bool unbounded = std::ranges::any_of(misfit, [](double m) { return !std::isfinite(m); });
  if (!reasons.empty() || unbounded) {
    const auto faults = recognised_faults(records.fitted, misfit, structure, settings_of(c));
    reasons.insert(reasons.begin(), faults.begin(), faults.end());
  }
  reasons.insert(reasons.end(), found.doubts.begin(), found.doubts.end());
  if (const Passivity& p = found.own.passivity; !p.passive)
    reasons.push_back(
        fmt::format("the model is not passive: it supplies energy to the shaker (damping {:.3g} N s/m at {:.4g} Hz)",
                    p.least_damping, p.worst_omega / (2.0 * std::numbers::pi)));
  return reasons;
}

/// With its verdict. A model that has no bounded response to a record that it was fitted to is no fit.
void judge(Found& found, const Records& records, const ModelStructure& structure, const MassMaterialCase& c) {
  double misfit = 0.0;
  for (const ExperimentMisfit& test : found.report.experiments)
    if (test.fitted) misfit = std::max(misfit, test.relative);
  judge(found.report.found, {.misfit = misfit, .reasons = reasons_against(found, records, structure, c)});
}

/// The method's answer; where it has none, the faults of the records that may be why.
Found identified(const Records& records, const ModelStructure& structure, const MassMaterialCase& c, Log& log) {
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

VibrationRecord record_of(const VibrationTest& test, const fs::path& results, Log& log) {
  if (test.record) return read_record(test, *test.record, log);
  RecordFile simulated;
  simulated.file = results / (test.name + ".csv");
  if (!fs::exists(simulated.file))
    throw test.where->error(
        fmt::format("the test names no record, and there is no {}; pfdm run simulates one", simulated.file.string()));
  return read_record(test, simulated, log);
}

void fit_mass_material(const MassMaterialProgram& program, Session& session) {
  const MassMaterialCase& c = program.parsed;
  const Stopwatch watch;
  const Records records = read_records(c, session.results, session.log);
  const ModelStructure& structure = model_structure(c.fit.structure);
  const FolderLock lock(session.results);
  session.log.say(fmt::format("pfdm {}, case {}: {} of model {} from {} records", session.version, program.name,
                              c.fit.method, structure.name, records.fitted.size()));
  Found found = identified(records, structure, c, session.log);
  if (c.sample) found.own.modulus = youngs_modulus(found.model, records, *c.sample);
  if (c.fit.ogden_terms > 0) found.own.ogden = ogden_of(found.model, records, c);
  if (c.fit.repeatability) found.own.repeats = repeats_of(found, records, c);
  found.own.structure = structure.name;
  FitReport& report = found.report;
  report.case_name = program.name;
  report.version = session.version;
  report.case_hash = program.hash;
  report.method = c.fit.method;
  report.confidence = c.fit.confidence;
  report.experiments = misfits(found.model, records, c.fit.crop);
  judge(found, records, structure, c);
  report.own = found.own;
  report.wall_seconds = watch.seconds();
  session.log.open_file(session.results / "fit.log", false);
  write_fit_json(session.results / "fit.json", report);
  write_file(session.results / "case.fitted.toml",
             with_table(program.file, "model", model_text(structure.name, found.model), session.results));
  say_found(found, session.log);
  session.log.say(
      fmt::format("written to {} after {:.1f} s", (session.results / "fit.json").string(), report.wall_seconds));
  say_verdict(report.found, session);
}

}  // namespace pfdm
