#include "cases/program/vibration/mass_material_report.h"

#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/vibration/mass_material_models.h"
#include "cases/program/vibration/vibration_charts.h"
#include "postproc/fits/fit_json.h"
#include "postproc/vibration/vibration_fit.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/identification/identification_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

struct Model {
  MassMaterial parameters;
  std::string label;
};

/// All that the page tells of.
struct VibrationStory {
  const MassMaterialProgram& program;
  std::vector<VibrationRecord> records;
  std::size_t shown = 0;  // the record with the largest level
  std::optional<FitReport> fit{};
  std::optional<VibrationFindings> findings{};  // of the fit
  std::optional<Model> model{};
  std::optional<VectorXd> predicted{};  // z'' [m/s^2]
  const VibrationRecord& record() const { return records[shown]; }
};

std::optional<Model> model_of(const MassMaterialCase& c, bool fitted, const fs::path& results) {
  if (fitted) {
    const CaseFile found = open_case(results / "case.fitted.toml");
    return Model{read_mass_material_case(found.config.root(), found.directory).model, "identified model"};
  }
  if (c.has_parameters) return Model{c.model, "model of the case"};
  return std::nullopt;
}

VibrationStory story_of(const MassMaterialProgram& program, const Session& session) {
  VibrationStory story{.program = program,
                       .records = {},
                       .fit = find_of_case(session.results / "fit.json", program.hash, read_fit_json)};
  for (const VibrationTest& test : program.parsed.tests)
    story.records.push_back(record_of(test, session.results, session.log));
  const auto level = [](const VibrationRecord& r) { return rms_of(r.base); };
  story.shown = static_cast<std::size_t>(std::ranges::max_element(story.records, {}, level) - story.records.begin());
  if (story.fit) story.findings = vibration_findings(story.fit->own);
  story.model = model_of(program.parsed, story.fit.has_value(), session.results);
  if (story.model) story.predicted = predicted_response(story.model->parameters, story.record());
  return story;
}

Table sample_table(const VibrationStory& story) {
  const MassMaterialCase& c = story.program.parsed;
  Table table{.caption = "Sample and conditions", .rows = {{"mass", shown(c.model.mass) + " kg"}}};
  const auto add = [&](std::string what, std::string value) {
    table.rows.push_back({std::move(what), std::move(value)});
  };
  if (c.sample) {
    add("sample length, area", fmt::format("{}, {}", shown(c.sample->length, "m"), shown(c.sample->area, "m^2")));
    add("diameter, if round", shown(std::sqrt(4.0 * c.sample->area / std::numbers::pi), "m"));
  }
  const VibrationRecord& r = story.record();
  add("shown below", r.name);
  add("excited band", fmt::format("{} to {} Hz", shown(r.band_low), shown(r.band_high)));
  add("sampling", fmt::format("{} at {} samples/s", shown(r.duration(), "s"), shown(r.rate)));
  return table;
}

std::string misfit_of(const std::optional<FitReport>& fit, const std::string& test) {
  if (!fit) return "-";
  const auto found = std::ranges::find(fit->experiments, test, &ExperimentMisfit::name);
  if (found == fit->experiments.end()) return "-";
  return fmt::format("{:.3g} %, {}", 100.0 * found->relative, found->fitted ? "fitted" : "predicted");
}

Table tests_table(const VibrationStory& story) {
  Table table{.caption = "Tests: rms accelerations",
              .rows = {{"test", "base [g0]", "relative [g0]", "misfit"}},
              .has_header = true};
  for (const VibrationRecord& r : story.records)
    table.rows.push_back({r.name, shown(rms_of(r.base) / standard_gravity),
                          shown(rms_of(r.relative) / standard_gravity), misfit_of(story.fit, r.name)});
  return table;
}

/// "k1_N_per_m" as "k1 [N/m]".
std::string with_bracketed_unit(const std::string& name) {
  const std::size_t at = name.find('_');
  if (at == std::string::npos) return name;
  std::string unit = fmt::format("{}{}", name[at + 1] == 'p' ? "1_" : "", name.substr(at + 1));
  for (std::size_t i; (i = unit.find("_per_")) != std::string::npos;) {
    unit.erase(i, 4);
    unit[i] = '/';
  }
  std::ranges::replace(unit, '_', ' ');
  if (std::isdigit(static_cast<unsigned char>(unit.back())) != 0 && unit.size() > 1) unit.insert(unit.end() - 1, '^');
  return fmt::format("{} [{}]", name.substr(0, at), unit);
}

Table model_table(const VibrationStory& story) {
  const std::string structure = story.findings ? story.findings->structure : story.program.parsed.structure;
  Table table{.caption = fmt::format("Model {}", structure), .rows = {}, .has_header = true};
  if (story.fit) {
    table.caption += fmt::format(", fit {}", verdict_text(story.fit->found));
    table.rows.push_back({"parameter", "value", fmt::format("{:g} % interval", 100.0 * story.fit->confidence)});
    for (const FittedParameter& p : story.fit->found.parameters)
      table.rows.push_back({with_bracketed_unit(p.name), shown(p.estimate),
                            std::isfinite(p.lower) ? fmt::format("{} to {}", shown(p.lower), shown(p.upper)) : "-"});
    if (story.findings && story.findings->ogden)
      for (const OgdenTerm& term : story.findings->ogden->terms)
        table.rows.push_back({"Ogden: mu, alpha", shown(term.mu, "Pa"), shown(term.alpha)});
  } else if (story.model) {
    table.rows.push_back({"parameter", "value"});
    for (const Estimate& e : named_values(story.model->parameters))
      table.rows.push_back({with_bracketed_unit(e.name), shown(e.value)});
  } else {
    table.rows.push_back({"not identified yet"});
  }
  return table;
}

Series part_of(const VectorXd& signal, double rate, Eigen::Index from, Eigen::Index n, std::string label) {
  Series series{.label = std::move(label), .x = {}, .y = {}};
  for (Eigen::Index i = from; i < from + n; ++i) {
    series.x.push_back(static_cast<double>(i) / rate);
    series.y.push_back(signal[i] / standard_gravity);
  }
  return series;
}

/// Some periods about the largest response.
Chart excerpt_chart(const VibrationStory& story) {
  constexpr double n_periods = 8.0;
  const VibrationRecord& r = story.record();
  const double period = 1.0 / std::sqrt(r.band_low * r.band_high);
  const Eigen::Index n = std::min(r.n(), static_cast<Eigen::Index>(std::ceil(n_periods * period * r.rate)));
  Eigen::Index peak = 0;
  r.relative.cwiseAbs().maxCoeff(&peak);
  const Eigen::Index from = std::clamp<Eigen::Index>(peak - n / 2, 0, r.n() - n);
  Chart chart{.caption = "About the largest response",
              .x = {.title = "time [s]"},
              .y = {.title = "acceleration [g0]"},
              .series = {part_of(r.relative, r.rate, from, n, "recorded")}};
  if (!story.predicted) return chart;
  chart.series.push_back(part_of(*story.predicted, r.rate, from, n, story.model->label));
  chart.series.back().style = SeriesStyle::dashed;
  chart.series.back().colour = 2;
  return chart;
}

void add_model(Chart& chart, const VibrationStory& story, const std::optional<BandSpectra>& model,
               std::vector<double> BandSpectra::*values) {
  if (!model) return;
  chart.series.push_back({.label = story.model->label,
                          .x = model->frequency,
                          .y = (*model).*values,
                          .style = SeriesStyle::dashed,
                          .colour = 2});
}

Chart magnitude_chart(const VibrationStory& story, const BandSpectra& s, const std::optional<BandSpectra>& model) {
  Chart chart{.caption = fmt::format("H1, base to relative acceleration, where coherence > {:g}", least_coherence),
              .x = frequency_axis(story.record()),
              .y = {.title = "magnitude [-]", .logarithmic = true},
              .series = {{.label = "95 % bounds",
                          .x = s.frequency,
                          .y = s.lower,
                          .style = SeriesStyle::band,
                          .colour = 7,
                          .upper = s.upper},
                         {.label = "recorded", .x = s.frequency, .y = s.magnitude}}};
  add_model(chart, story, model, &BandSpectra::magnitude);
  return chart;
}

Chart phase_chart(const VibrationStory& story, const BandSpectra& s, const std::optional<BandSpectra>& model) {
  Chart chart{.caption = "H1: phase",
              .x = frequency_axis(story.record()),
              .y = {.title = "phase [degrees]"},
              .series = {{.label = "recorded", .x = s.frequency, .y = s.phase}}};
  add_model(chart, story, model, &BandSpectra::phase);
  return chart;
}

std::string percent(double part, double mean) { return fmt::format("{:.2g} %", 100.0 * part / std::abs(mean)); }

Table repeatability_table(const RepeatedIdentification& repeats) {
  Table table{.caption = "Each record on its own, in % of the mean; slopes by least squares with 95 % intervals",
              .rows = {{"parameter", "mean", "between repeats", "by noise"}},
              .has_header = true};
  for (const Effect& e : repeats.parameters.front().statistics.effects)
    table.rows.front().push_back(e.name == "per_g0" ? "per g0" : e.name == "per_day" ? "per day" : "per run");
  for (const ParameterRepeatability& p : repeats.parameters) {
    const Repeatability& r = p.statistics;
    table.rows.push_back({with_bracketed_unit(p.name), shown(r.mean),
                          r.repeat_deviation ? percent(*r.repeat_deviation, r.mean) : "-",
                          percent(p.expected_deviation, r.mean)});
    for (const Effect& e : r.effects)
      table.rows.back().push_back(fmt::format("{:+.2g} ± {:.1g} %", 100.0 * e.value / std::abs(r.mean),
                                              50.0 * (e.upper_95 - e.lower_95) / std::abs(r.mean)));
  }
  return table;
}

/// One parameter of each record, in % off the mean, in the order of the tests; a series for each level.
Chart repeats_chart(const RepeatedIdentification& repeats, std::size_t parameter) {
  const ParameterRepeatability& p = repeats.parameters[parameter];
  Chart chart{.caption = fmt::format("{} of each record", p.name.substr(0, p.name.find('_'))),
              .x = {.title = "age of the sample [day], runs of a day side by side"},
              .y = {.title = "off the mean [%]"},
              .series = {}};
  std::map<double, Series> levels;
  for (const RecordEstimates& r : repeats.records) {
    Series& series = levels[r.schedule.level];
    series.label = fmt::format("{} g0", shown(r.schedule.level / standard_gravity));
    series.style = SeriesStyle::points;
    series.x.push_back(static_cast<double>(r.schedule.day()) + 0.15 * r.schedule.run);
    series.y.push_back(100.0 * (r.estimates[parameter].value / p.statistics.mean - 1.0));
  }
  int colour = 1;
  for (auto& [level, series] : levels) {
    series.colour = colour++;
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// k1 and c, which every structure has.
void add_repeats(ReportPage& page, const RepeatedIdentification& repeats) {
  page.rows.push_back({.blocks = {repeatability_table(repeats)}});
  PageRow charts;
  for (std::size_t i = 0; i < repeats.parameters.size(); ++i)
    if (repeats.parameters[i].name.starts_with("k1_") || repeats.parameters[i].name.starts_with("c_"))
      charts.blocks.emplace_back(repeats_chart(repeats, i));
  page.rows.push_back(std::move(charts));
}

/// Of a remark: as far as the first semicolon or the end of the line.
std::string first_clause(const std::string& text) { return text.substr(0, text.find_first_of(";\n")); }

}  // namespace

ReportPage mass_material_page(const MassMaterialProgram& program, const Session& session) {
  const VibrationStory story = story_of(program, session);
  const VibrationRecord& record = story.record();
  const SegmentSettings& segments = program.parsed.analysis.segments;
  BandSpectra measured = spectra_in_band(record, record.relative, segments);
  std::optional<BandSpectra> model;
  if (story.predicted && story.predicted->allFinite()) model = spectra_in_band(record, *story.predicted, segments);
  blank_incoherent(measured, measured.coherence);
  if (model) blank_incoherent(*model, measured.coherence);
  const std::string says = record.remark.empty() ? "" : fmt::format(", record {}", first_clause(record.remark));
  ReportPage page{.title = fmt::format("{}: {}", program.name, program.parsed.title),
                  .subtitle = fmt::format("pfdm {}, case {}{}", session.version, program.hash, says),
                  .rows = {}};
  page.rows.push_back(
      {.blocks = {sample_table(story), tests_table(story), model_table(story)}, .widths = {0.75, 1.2, 1.1}});
  if (const auto rows = schedule_rows(program.parsed); !rows.empty())
    page.rows.push_back(
        {.blocks = {Table{.caption = "Schedule: days of the tests", .rows = rows, .has_header = true}}});
  page.rows.push_back({.blocks = {base_chart(record), response_chart(record), excerpt_chart(story)}});
  page.rows.push_back({.blocks = {magnitude_chart(story, measured, model), phase_chart(story, measured, model)}});
  PageRow last{.blocks = {density_chart(record, measured), coherence_chart(record, measured)}};
  const auto& findings = story.findings;
  if (findings && !findings->modulus.empty()) last.blocks.emplace_back(modulus_chart(findings->modulus));
  page.rows.push_back(std::move(last));
  if (findings && findings->repeats) add_repeats(page, *findings->repeats);
  if (const auto models = find_of_case(session.results / models_file, program.hash, read_model_comparison))
    add_models(page, *models, record, segments, session.results);
  for (const char* log : {"run.log", "fit.log"})
    for (PageRow& row : warnings_row(session.results / log)) page.rows.push_back(std::move(row));
  return page;
}

}  // namespace pfdm
