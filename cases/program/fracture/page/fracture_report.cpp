#include "cases/program/fracture/page/fracture_report.h"

#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/interface_chart.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/fracture/page/fit_on_page.h"
#include "cases/program/fracture/page/fracture_pictures.h"
#include "cases/program/fracture/page/fracture_side_by_side.h"
#include "cases/program/fracture/page/fracture_story.h"
#include "cases/program/fracture/page/heat_charts.h"
#include "cases/program/fracture/page/law_chart.h"
#include "cases/program/session/report_parts.h"
#include "postproc/cohesive/cohesive_law.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

template <class Value>
std::vector<double> column(const std::vector<CurveRow>& rows, const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const CurveRow& row : rows) values.push_back(value(row));
  return values;
}

/// A measured curve, the band of two standard deviations about it, and what was recorded if that is not the same.
void add_specimens(Chart& chart, const std::vector<MeasuredCurve>& specimens, const DisplayUnit& x,
                   const DisplayUnit& y) {
  int colour = 1;
  for (const MeasuredCurve& measured : specimens) {
    const SampledCurve specimen = measured.of_specimen();
    const std::vector<double> at = in_unit(specimen.x, x), values = in_unit(specimen.y, y);
    if (!specimen.deviation.empty()) {
      Series band{.label = "two standard deviations", .x = at, .y = {}, .style = SeriesStyle::band, .colour = 7};
      for (std::size_t i = 0; i < values.size(); ++i) {
        band.y.push_back(values[i] - 2.0 * y.factor * specimen.deviation[i]);
        band.upper.push_back(values[i] + 2.0 * y.factor * specimen.deviation[i]);
      }
      chart.series.insert(chart.series.begin(), std::move(band));
    }
    if (!measured.treatment().empty())
      chart.series.push_back({.label = "as recorded, " + specimen.name,
                              .x = in_unit(measured.as_recorded.x, x),
                              .y = in_unit(measured.as_recorded.y, y),
                              .style = SeriesStyle::dashed,
                              .colour = 7});
    chart.series.push_back({.label = specimen.name, .x = at, .y = values, .colour = colour++});
  }
}

Chart force_chart(const FractureStory& story) {
  const int k = story.component();
  const std::vector<double> u = column(story.curve, [](const CurveRow& row) { return row.displacement; });
  const std::vector<double> force = column(story.curve, [k](const CurveRow& row) { return row.force[k]; });
  const DisplayUnit x = common_unit({{u}}, "m"), y = common_unit({{force}}, "N");
  Chart chart{.caption = "Force against displacement",
              .x = {.title = fmt::format("displacement {} of {} [{}]", story.direction(),
                                         story.fracture.output.curve.patch, x.name)},
              .y = {.title = fmt::format("force {} [{}]", story.direction(), y.name)},
              .series = {}};
  if (story.experiment) add_specimens(chart, story.experiment->specimens, x, y);
  chart.series.push_back({.label = story.experiment ? "computed" : "",
                          .x = in_unit(u, x),
                          .y = in_unit(force, y),
                          .style = SeriesStyle::line_with_points,
                          .of_steps = true});
  return chart;
}

/// Of a box that is loaded by its mean strain.
Chart mean_chart(const FractureStory& story, const std::filesystem::path& results) {
  const std::array<int, 2>& component = story.fracture.box->component;
  const MeanCurve curve = read_mean_curve(results, story.fracture.interfaces, component);
  const DisplayUnit y = common_unit({{curve.stress}}, "Pa");
  const std::string_view name = name_of_component(component);
  return {.caption = "Mean stress against mean strain",
          .x = {.title = fmt::format("strain {} [-]", name)},
          .y = {.title = fmt::format("stress {} [{}]", name, y.name)},
          .series = {{.label = {},
                      .x = curve.strain,
                      .y = in_unit(curve.stress, y),
                      .style = SeriesStyle::line_with_points,
                      .of_steps = curve.strain.size() == story.curve.size()}}};
}

Chart energy_chart(const FractureStory& story) {
  const std::vector<double> load = column(story.curve, [](const CurveRow& row) { return row.load; });
  std::vector<std::vector<double>> energies{
      column(story.curve, [](const CurveRow& row) { return supplied(row.energy); }),
      column(story.curve, [](const CurveRow& row) { return row.energy.elastic; }),
      column(story.curve, [](const CurveRow& row) { return row.energy.fracture; })};
  std::vector<std::string_view> names{"work", "elastic", "surface"};
  const std::vector<double> lost = column(story.curve, [](const CurveRow& row) { return dissipated(row.energy); });
  if (lost.back() > 0.0) {
    energies.push_back(lost);
    names.emplace_back("dissipated");
  }
  const DisplayUnit unit = common_unit(energies, "J");
  Chart chart{.caption = "Energies",
              .x = {.title = "load parameter t [-]"},
              .y = {.title = fmt::format("energy [{}]", unit.name)},
              .series = {}};
  add_series(chart, load, energies, names, unit);
  for (Series& series : chart.series) series.of_steps = true;
  return chart;
}

Chart iterations_chart(const FractureStory& story) {
  return {.caption = "Staggered iterations",
          .x = {.title = "step [-]"},
          .y = {.title = "iterations [-]", .from = 0.0},
          .series = {{.label = {},
                      .x = column(story.curve, [](const CurveRow& row) { return row.step; }),
                      .y = column(story.curve, [](const CurveRow& row) { return row.staggered_iterations; }),
                      .style = SeriesStyle::line_with_points,
                      .of_steps = true}}};
}

/// Whether the first surface has one.
bool has_law(const std::vector<ColumnRecord>& records) {
  return !records.empty() && n_never_damaged(records.front()) < records.front().places.size();
}

/// Of the first surface: the law that was extracted, or the given one of an interface beside what its faces did.
Chart first_law_chart(const FractureStory& story) {
  const ColumnRecord& record = story.records.front();
  const auto& interfaces = story.fracture.interfaces;
  const auto given = std::ranges::find(interfaces, record.name, &InterfaceSettings::name);
  return record.is_cohesive && given != interfaces.end() ? interface_chart(*given, record)
                                                         : law_chart(record, story.fracture.cohesive.axis);
}

/// Tables, pictures and charts of a run.
std::vector<PageRow> run_rows(const FractureStory& story, const std::filesystem::path& results) {
  std::vector<PageRow> rows;
  rows.push_back({.blocks = {run_table(story), figures_table(story), material_table(story.fracture)},
                  .widths = {1.25, 0.9, 0.95}});
  std::vector<PageBlock> blocks = damage_pictures(story.fracture, story.curve, results);
  for (PageBlock& picture : interface_pictures(story.curve, results)) blocks.push_back(std::move(picture));
  blocks.emplace_back(story.fracture.box ? mean_chart(story, results) : force_chart(story));
  blocks.emplace_back(energy_chart(story));
  if (has_law(story.records)) blocks.emplace_back(first_law_chart(story));
  for (PageBlock& chart : heat_charts(results)) blocks.push_back(std::move(chart));
  blocks.emplace_back(iterations_chart(story));
  if (story.experiment)
    for (PageBlock& chart :
         side_by_side_charts(*story.experiment, story.curve, story.records, story.fracture.cohesive.axis))
      blocks.push_back(std::move(chart));
  for (PageRow& row : in_pairs(std::move(blocks))) rows.push_back(std::move(row));
  if (!story.experiment) return rows;
  if (auto table = side_by_side_table(*story.experiment, story.curve, story.component(), story.records,
                                      story.fracture.cohesive.axis))
    rows.push_back({.blocks = {std::move(*table)}});
  return rows;
}

/// That of this case. One of the case before it was changed is of no concern to a run.
std::optional<FitReport> find_fit(const std::filesystem::path& results, const std::string& hash) {
  const std::filesystem::path file = results / "fit.json";
  if (!has_results(results)) return find_of_case(file, hash, read_fit_json);
  if (!std::filesystem::exists(file)) return std::nullopt;
  FitReport fit = read_fit_json(file);
  if (fit.case_hash != hash) return std::nullopt;
  return fit;
}

std::string subtitle_of(const std::optional<RunSummary>& summary, bool has_run, const std::optional<FitReport>& fit,
                        const std::string& hash) {
  if (!has_run) return fmt::format("pfdm {}, case {}, fitted, not run", fit->version, hash);
  if (!summary) return fmt::format("case {}, not finished", hash);
  return fmt::format("pfdm {}, case {}, {}", summary->version, hash, summary->status);
}

}  // namespace

ReportPage fracture_page(const FractureCase& fracture, const std::optional<ExperimentSettings>& experiment,
                         const std::string& name, const std::string& hash, const std::filesystem::path& results) {
  const auto fit = find_fit(results, hash);
  const bool has_run = !fit || has_results(results);
  ReportPage page{.title = fmt::format("{}: {}", name, fracture.title), .subtitle = {}, .rows = {}};
  if (has_run) {
    const FractureStory story{.fracture = fracture,
                              .experiment = experiment,
                              .curve = read_curve_record(results, hash),
                              .summary = find_summary(results),
                              .records = find_column_record(results)};
    page.subtitle = subtitle_of(story.summary, true, fit, hash);
    page.rows = run_rows(story, results);
  } else {
    page.subtitle = subtitle_of(std::nullopt, false, fit, hash);
  }
  if (fit)
    for (PageRow& row : fit_on_page(*fit, results)) page.rows.push_back(std::move(row));
  for (const char* log : {"run.log", "fit.log"})
    for (PageRow& row : warnings_row(results / log)) page.rows.push_back(std::move(row));
  return page;
}

ReportPage running_page(const FractureCase& fracture, const std::optional<ExperimentSettings>& experiment,
                        const std::string& title, std::vector<CurveRow> curve) {
  const FractureStory story{.fracture = fracture,
                            .experiment = experiment,
                            .curve = std::move(curve),
                            .summary = std::nullopt,
                            .records = {}};
  ReportPage page{.title = title, .subtitle = "curves of the run, without its fields", .rows = {}};
  std::vector<PageBlock> blocks;
  if (!fracture.box) blocks.emplace_back(force_chart(story));
  blocks.emplace_back(energy_chart(story));
  blocks.emplace_back(iterations_chart(story));
  if (!fracture.box) blocks.emplace_back(figures_table(story));
  blocks.emplace_back(material_table(fracture));
  page.rows = in_pairs(std::move(blocks));
  return page;
}

}  // namespace pfdm
