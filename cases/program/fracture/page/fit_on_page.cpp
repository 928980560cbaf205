#include "cases/program/fracture/page/fit_on_page.h"

#include "cases/program/fracture/page/field_pictures.h"
#include "cases/program/fracture/page/posterior_charts.h"
#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/report_parts.h"
#include "postproc/curves/curve_events.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pfdm {
namespace {

/// "200 MPa", "392 J/m^2" (a quotient takes no prefix), 0.3 of what has no unit.
std::string value_text(double value, const std::string& unit) {
  if (unit.empty() || unit == "1") return shown(value);
  return unit.find('/') == std::string::npos ? shown(value, unit) : fmt::format("{} {}", shown(value), unit);
}

std::string between_text(double lower, double upper, const std::string& unit) {
  if (!std::isfinite(lower) || !std::isfinite(upper)) return "none";
  const int digits = digits_of_interval(lower, upper, 4);
  const DisplayUnit in = unit.find('/') == std::string::npos && !unit.empty() && unit != "1"
                             ? display_unit(std::max(std::abs(lower), std::abs(upper)), unit)
                             : DisplayUnit{.name = unit == "1" ? std::string() : unit};
  return fmt::format("{:.{}g} to {:.{}g}{}{}", in.factor * lower, digits, in.factor * upper, digits,
                     in.name.empty() ? "" : " ", in.name);
}

std::string profile_text(const FittedParameter& p) {
  if (!p.profile) return "none";
  const auto end = [&](double value, bool open) { return value_text(value, p.unit) + (open ? " (the bound)" : ""); };
  return fmt::format("{} to {}", end(p.profile->lower, p.profile->lower_open),
                     end(p.profile->upper, p.profile->upper_open));
}

std::string posterior_text(const FittedParameter& p) {
  if (!p.posterior) return "none";
  return fmt::format("{}, {}", value_text(p.posterior->median, p.unit),
                     between_text(p.posterior->lower, p.posterior->upper, p.unit));
}

/// Jumps between two forces, or a point each, as the curves beside them without what the set-up adds.
void mark_events(const std::vector<FittedEvent>& events, const DisplayUnit& x, const DisplayUnit& y, Chart& chart) {
  Series measured{.label = "events, measured", .x = {}, .y = {}, .style = SeriesStyle::line_with_points, .colour = 3};
  Series fitted{.label = "events, fitted", .x = {}, .y = {}, .style = SeriesStyle::line_with_points, .colour = 2};
  for (const FittedEvent& event : events) {
    using Figure = FittedEvent::Figure;
    const auto add = [&](Series& series, double Figure::*value) {
      const auto known = [&](const std::string& name) {
        const double of_event = event.figure(name, value);
        return std::isfinite(of_event) ? of_event : event.figure(name, &Figure::computed);
      };
      if (!series.x.empty()) {  // no line from one event to the next
        series.x.push_back(std::nan(""));
        series.y.push_back(std::nan(""));
      }
      for (const char* force : {"force_before", "force_after", "force"})
        if (const double at = known(force); std::isfinite(at)) {
          const double force_of_specimen = at - event.set_up.force_offset;
          series.x.push_back(
              x.factor * (known("displacement") - event.set_up.offset - event.set_up.compliance * force_of_specimen));
          series.y.push_back(y.factor * force_of_specimen);
        }
    };
    add(measured, &Figure::measured);
    if (event.is_there) add(fitted, &Figure::computed);
  }
  for (Series* series : {&measured, &fitted})
    if (!series->x.empty()) chart.series.push_back(std::move(*series));
}

Chart curves_chart(const FitReport& fit, const ExperimentMisfit& experiment, const CsvTable& curves) {
  const std::vector<double>&u = curves.column("displacement_m"), &measured = curves.column("measured_force_N"),
        &first = curves.column("first_force_N"), &fitted = curves.column("model_force_N");
  const DisplayUnit x = common_unit({{u}}, "m"), y = common_unit({{measured, fitted}}, "N");
  const std::vector<double> at = in_unit(u, x);
  Chart chart{
      .caption = fmt::format("Fit to \"{}\", rms misfit {:.2g} %", experiment.name, 100.0 * experiment.relative),
      .x = {.title = fmt::format("displacement [{}]", x.name)},
      .y = {.title = fmt::format("force [{}]", y.name)},
      .series = {{.label = "measured", .x = at, .y = in_unit(measured, y), .style = SeriesStyle::points, .colour = 5},
                 {.label = "first guess", .x = at, .y = in_unit(first, y), .style = SeriesStyle::dashed, .colour = 1},
                 {.label = "fitted", .x = at, .y = in_unit(fitted, y), .colour = 0}}};
  mark_events(fit.events, x, y, chart);
  return chart;
}

/// By how much each parameter moves each part of the curve; the table's comments say how far it is moved.
Chart sensitivity_chart(const CsvTable& table) {
  const std::size_t n = table.columns.size() - 1;
  const std::vector<double>& displacement = table.columns.front();
  std::vector<std::vector<double>> changes(table.columns.begin() + 1, table.columns.end());
  const DisplayUnit x = common_unit({{displacement}}, "m"), y = common_unit(changes, "N");
  Chart chart{.caption = "What determines what: change of the computed force",
              .x = {.title = fmt::format("displacement [{}]", x.name)},
              .y = {.title = fmt::format("change of the force [{}]", y.name)},
              .series = {}};
  for (std::size_t k = 0; k < n; ++k)
    chart.series.push_back({.label = table.comments[table.comments.size() - n + k],
                            .x = in_unit(displacement, x),
                            .y = in_unit(changes[k], y),
                            .colour = static_cast<int>(k)});
  return chart;
}

/// What was measured of events, and what the fitted curve has.
Table events_table(const std::vector<FittedEvent>& events) {
  Table table{.caption = "Events",
              .rows = {{"event", "figure", "measured", "standard deviation", "fitted", "residual [deviations]"}},
              .has_header = true};
  for (const FittedEvent& event : events)
    for (const FittedEvent::Figure& f : event.figures) {
      if (!std::isfinite(f.measured)) continue;
      table.rows.push_back({fmt::format("{} of {}{}", event.name, event.specimen, event.is_there ? "" : ", not fitted"),
                            in_words(f.name), value_text(f.measured, f.unit), value_text(f.deviation, f.unit),
                            value_text(f.computed, f.unit),
                            std::isfinite(f.residual) ? fmt::format("{:+.2f}", f.residual) : "no datum"});
    }
  return table;
}

}  // namespace

Table estimates_table(const FitReport& fit) {
  const std::vector<FittedParameter>& parameters = fit.found.parameters;
  const bool has_profiles = std::ranges::any_of(parameters, [](const auto& p) { return p.profile.has_value(); });
  Table table{
      .caption = fmt::format("Fit: {}", verdict_text(fit.found)),
      .rows = {{"parameter", "first guess", "estimate", fmt::format("{:g} % interval", 100.0 * fit.confidence)}},
      .has_header = true};
  if (has_profiles) table.rows.front().emplace_back("by profile likelihood");
  if (const auto& posterior = fit.found.posterior)
    table.rows.front().emplace_back(posterior->discrepancy ? "posterior with discrepancy: median, interval"
                                                           : "posterior: median, interval");
  for (const FittedParameter& p : parameters) {
    table.rows.push_back({p.name, value_text(p.first_guess, p.unit), value_text(p.estimate, p.unit),
                          between_text(p.lower, p.upper, p.unit)});
    if (has_profiles) table.rows.back().push_back(profile_text(p));
    if (fit.found.posterior) table.rows.back().push_back(posterior_text(p));
  }
  return table;
}

std::vector<PageRow> fit_on_page(const FitReport& fit, const std::filesystem::path& results) {
  std::vector<PageRow> rows{{.blocks = {estimates_table(fit)}}};
  if (!fit.events.empty()) rows.push_back({.blocks = {events_table(fit.events)}});
  std::vector<PageBlock> charts;
  std::set<std::string> seen;  // one file for all specimens
  for (const ExperimentMisfit& experiment : fit.experiments)
    if (!experiment.curve.empty() && seen.insert(experiment.curve).second)
      charts.emplace_back(curves_chart(fit, experiment, read_csv(results / experiment.curve)));
  if (const std::string& file = fit.found.sensitivity_file; !file.empty())
    charts.emplace_back(sensitivity_chart(read_csv(results / file)));
  if (fit.found.posterior)
    for (Chart& chart : posterior_charts(fit, results)) charts.emplace_back(std::move(chart));
  for (PageRow& row : in_pairs(std::move(charts))) rows.push_back(std::move(row));
  for (PageRow& row : field_rows(fit, results)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace pfdm
