// fit_mass_material() of mass_material_jobs.h.

#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/vibration/mass_material_identified.h"
#include "cases/program/vibration/mass_material_jobs.h"
#include "cases/program/vibration/mass_material_models.h"
#include "cases/program/vibration/mass_material_ten_steps.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "postproc/fits/fit_json.h"
#include "postproc/vibration/vibration_fit.h"
#include "solver/vibration/identification/identification.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

MassMaterialRecords read_records(const MassMaterialCase& c, const fs::path& results, Log& log) {
  MassMaterialRecords records;
  for (const VibrationTest& test : c.tests)
    (test.predicted ? records.predicted : records.fitted).push_back(record_of(test, results, log));
  if (records.fitted.empty()) throw InputError("every test is predicted; at least one has to be fitted");
  return records;
}

/// E' + j E'' = K L/A: the sample as a bar in uniaxial stress, whose own inertia counts as a third of its mass in m.
std::vector<ModulusRow> youngs_modulus(const MassMaterial& model, const MassMaterialRecords& records,
                                       const SampleSize& sample) {
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
OgdenFit ogden_of(const MassMaterial& model, const MassMaterialRecords& records, const MassMaterialCase& c) {
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

RepeatedIdentification repeats_of(const IdentifiedModel& found, const MassMaterialRecords& records,
                                  const MassMaterialCase& c) {
  std::vector<ScheduledRun> schedule;
  for (const VibrationTest& test : c.tests)
    if (!test.predicted) schedule.push_back(*test.schedule);
  return identify_each(records.fitted, schedule, found.model, settings_of(c));
}

void say_found(const IdentifiedModel& found, Log& log) {
  for (const FittedParameter& p : found.report.found.parameters)
    log.say(fmt::format("  {:<18} {}", p.name, estimate_text(p, found.report.confidence)));
  for (const ExperimentMisfit& test : found.report.experiments)
    log.say(fmt::format("  test {:<16} {}, relative misfit {:.3g}", test.name, test.fitted ? "fitted" : "predicted",
                        test.relative));
  if (found.own.ogden) say_ogden(*found.own.ogden, log);
  if (found.own.repeats) say_repeats(*found.own.repeats, log);
}

/// All models of [fit] that have parameters, and how they compare.
struct IdentifiedModels {
  ModelComparison comparison;
  std::map<std::string, IdentifiedModel> found;
};

/// One after the other. Throws ComputationError, that of the last, where none has parameters.
IdentifiedModels identified_models(const MassMaterialProgram& program, const MassMaterialRecords& records,
                                   Session& session) {
  const MassMaterialCase& c = program.parsed;
  IdentifiedModels all{.comparison = {.case_name = program.name,
                                      .case_hash = program.hash,
                                      .version = session.version,
                                      .method = c.fit.method,
                                      .chosen = {},
                                      .models = {}},
                       .found = {}};
  const std::vector<std::string> structures =
      c.fit.models.empty() ? std::vector<std::string>{c.fit.structure} : c.fit.models;
  for (const std::string& name : structures) {
    try {
      if (structures.size() > 1) session.log.say(fmt::format("model {}", name));
      IdentifiedModel found = identified(records, model_structure(name), c, session.log);
      all.comparison.models.push_back(summary_of(found));
      all.found.emplace(name, std::move(found));
    } catch (const ComputationError& error) {
      all.comparison.models.push_back(not_found(name, error.what()));
      if (structures.size() == all.comparison.models.size() && all.found.empty()) throw;
    }
  }
  all.comparison.chosen = all.comparison.models[best_of(all.comparison.models)].structure;
  return all;
}

std::string structures_text(const MassMaterialFit& fit) {
  return fit.models.empty() ? fmt::format("model {}", fit.structure)
                            : fmt::format("models {}", fmt::join(fit.models, ", "));
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
  const MassMaterialRecords records = read_records(c, session.results, session.log);
  const FolderLock lock(session.results);
  session.log.say(fmt::format("pfdm {}, case {}: {} of {} from {} records", session.version, program.name, c.fit.method,
                              structures_text(c.fit), records.fitted.size()));
  auto [comparison, all] = identified_models(program, records, session);
  IdentifiedModel& found = all.at(comparison.chosen);
  if (c.sample) found.own.modulus = youngs_modulus(found.model, records, *c.sample);
  if (c.fit.ogden_terms > 0) found.own.ogden = ogden_of(found.model, records, c);
  if (c.fit.repeatability) found.own.repeats = repeats_of(found, records, c);
  FitReport& report = found.report;
  report.case_name = program.name;
  report.version = session.version;
  report.case_hash = program.hash;
  report.own = own_findings(found.own);
  report.wall_seconds = watch.seconds();
  session.log.open_file(session.results / "fit.log", false);
  remove_comparison(session.results);
  write_fit_json(session.results / "fit.json", report);
  write_ten_steps(session.results, found.ten_steps, records.fitted.front().rate, session.log);
  const auto write_case = [&](const fs::path& file, const IdentifiedModel& model) {
    write_file(file, with_table(program.file, "model", model_text(model.own.structure, model.model), session.results));
  };
  write_case(session.results / "case.fitted.toml", found);
  if (!c.fit.models.empty()) {
    for (const auto& [structure, model] : all) write_case(fitted_case_of(session.results, structure), model);
    write_model_comparison(session.results / models_file, comparison);
    say_models(comparison, session.log);
  }
  say_found(found, session.log);
  session.log.say(
      fmt::format("written to {} after {:.1f} s", (session.results / "fit.json").string(), report.wall_seconds));
  say_verdict(report.found, session);
}

}  // namespace pfdm
