#include "cases/program/vibration/mass_material_models.h"

#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/vibration/vibration_charts.h"
#include "solver/vibration/identification/identification_responses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

double mean_misfit(const std::vector<ExperimentMisfit>& tests, bool fitted) {
  double sum = 0.0;
  int n = 0;
  for (const ExperimentMisfit& test : tests)
    if (test.fitted == fitted) sum += test.relative, ++n;
  return n > 0 ? sum / n : FittedModel::unknown;
}

std::string percent(double part) { return std::isfinite(part) ? fmt::format("{:.3g} %", 100.0 * part) : "-"; }

/// Over the least of all.
std::string information(const ModelComparison& comparison, const FittedModel& m) {
  double least = std::numeric_limits<double>::infinity();
  for (const FittedModel& other : comparison.models)
    if (std::isfinite(other.bic)) least = std::min(least, other.bic);
  return std::isfinite(m.bic) ? fmt::format("{:+.4g}", m.bic - least) : "-";
}

std::string marked(const ModelComparison& comparison, const FittedModel& m) {
  return m.structure + (m.structure == comparison.chosen ? " *" : "");
}

/// "k1 2.76e+06 N/m"
std::string shown_estimate(const Estimate& e) {
  const std::string name = e.name.substr(0, e.name.find('_', 1));
  return fmt::format("{} {:.4g}{}{}", name, e.value, e.unit.empty() || e.unit == "1" ? "" : " ",
                     e.unit == "1" ? "" : e.unit);
}

std::string parameters_of(const FittedModel& m) {
  std::string text;
  for (const Estimate& e : m.estimates) text += (text.empty() ? "" : ", ") + shown_estimate(e);
  return text;
}

Table models_table(const ModelComparison& comparison) {
  Table table{.caption =
                  "Models fitted to the same records (* the one above); misfits are means over the tests, BIC is "
                  "over the least",
              .rows = {{"model", "kernel terms", "misfit", "predicted", "BIC", "verdict", "parameters"}},
              .has_header = true};
  for (const FittedModel& m : comparison.models)
    table.rows.push_back({marked(comparison, m), fmt::format("{}", m.kernel_terms), percent(m.misfit),
                          percent(m.predicted_misfit), information(comparison, m), std::string(name_of(m.verdict)),
                          m.is_found() ? parameters_of(m) : m.reasons.front()});
  return table;
}

Chart overlay(std::string caption, std::string title, const VibrationRecord& record) {
  return {.caption = std::move(caption), .x = frequency_axis(record), .y = {.title = std::move(title)}, .series = {}};
}

}  // namespace

FittedModel summary_of(const IdentifiedModel& found) {
  const FitFindings& f = found.report.found;
  FittedModel m{.structure = found.own.structure,
                .kernel_terms = static_cast<int>(found.model.kernel.size()),
                .verdict = f.verdict,
                .reasons = f.reasons,
                .misfit = mean_misfit(found.report.experiments, true),
                .predicted_misfit = mean_misfit(found.report.experiments, false),
                .bic = found.bic};
  for (const FittedParameter& p : f.parameters)
    m.estimates.push_back({.name = p.name, .unit = p.unit, .value = p.estimate, .lower = p.lower, .upper = p.upper});
  return m;
}

FittedModel not_found(const std::string& structure, const std::string& why) {
  return {.structure = structure, .verdict = Verdict::failed, .reasons = {why}};
}

void say_models(const ModelComparison& comparison, Log& log) {
  log.say("models fitted to the same records; misfits are means over the tests, BIC is over the least:");
  log.say(fmt::format("  {:<12} {:>12} {:>10} {:>10} {:>12}  {}", "model", "kernel terms", "misfit", "predicted", "BIC",
                      "verdict"));
  for (const FittedModel& m : comparison.models) {
    log.say(fmt::format("  {:<12} {:>12} {:>10} {:>10} {:>12}  {}", marked(comparison, m), m.kernel_terms,
                        percent(m.misfit), percent(m.predicted_misfit), information(comparison, m),
                        name_of(m.verdict)));
    log.say(fmt::format("  {:<12} {}", "", m.is_found() ? parameters_of(m) : m.reasons.front()));
  }
  log.say(fmt::format("  * model {}: what follows, fit.json and case.fitted.toml are of it", comparison.chosen));
}

fs::path fitted_case_of(const fs::path& results, const std::string& structure) {
  return results / fmt::format("case.fitted_{}.toml", structure);
}

void remove_comparison(const fs::path& results) {
  const fs::path file = results / models_file;
  if (!fs::exists(file)) return;
  std::error_code ignored;
  try {
    for (const FittedModel& m : read_model_comparison(file).models)
      fs::remove(fitted_case_of(results, m.structure), ignored);
  } catch (const InputError&) {
    // Of another version: the file alone goes.
  }
  fs::remove(file, ignored);
}

void add_models(ReportPage& page, const ModelComparison& comparison, const VibrationRecord& record,
                const SegmentSettings& segments, const fs::path& results) {
  page.rows.push_back({.blocks = {models_table(comparison)}});
  BandSpectra measured = spectra_in_band(record, record.relative, segments);
  blank_incoherent(measured, measured.coherence);
  Chart magnitude = overlay("H1 of the recorded response and of all models", "magnitude [-]", record);
  Chart phase = overlay("its phase", "phase [degrees]", record);
  magnitude.y.logarithmic = true;
  magnitude.series.push_back({.label = "recorded", .x = measured.frequency, .y = measured.magnitude});
  phase.series.push_back({.label = "recorded", .x = measured.frequency, .y = measured.phase});
  int colour = 1;
  for (const FittedModel& m : comparison.models) {
    const fs::path file = fitted_case_of(results, m.structure);
    if (!m.is_found() || !fs::exists(file)) continue;
    const CaseFile fitted = open_case(file);
    const MassMaterial model = read_mass_material_case(fitted.config.root(), fitted.directory).model;
    const Eigen::VectorXd response = predicted_response(model, record);
    if (!response.allFinite()) continue;
    BandSpectra s = spectra_in_band(record, response, segments);
    blank_incoherent(s, measured.coherence);
    const std::string label = "model " + m.structure;
    magnitude.series.push_back(
        {.label = label, .x = s.frequency, .y = s.magnitude, .style = SeriesStyle::dashed, .colour = colour});
    phase.series.push_back(
        {.label = label, .x = s.frequency, .y = s.phase, .style = SeriesStyle::dashed, .colour = colour});
    ++colour;
  }
  page.rows.push_back({.blocks = {std::move(magnitude), std::move(phase)}});
}

}  // namespace pfdm
