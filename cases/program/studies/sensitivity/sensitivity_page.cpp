#include "cases/program/studies/sensitivity/sensitivity_page.h"

#include "cases/program/session/report_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr std::size_t most_lines = 7, columns_of_events = 5;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Both charts have the same axis of displacements.
ChartAxis displacement_axis(const CaseSensitivity& found, const DisplayUnit& unit) {
  return {.title = fmt::format("displacement [{}]", unit.name),
          .from = unit.factor * found.curve.x.front(),
          .to = unit.factor * found.curve.x.back()};
}

Chart force_chart(const CaseSensitivity& found, const DisplayUnit& x) {
  const DisplayUnit y = common_unit({{found.curve.y}}, "N");
  Chart chart{.caption = "Force against displacement",
              .x = displacement_axis(found, x),
              .y = {.title = fmt::format("force [{}]", y.name)},
              .series = {{.label = "computed",
                          .x = in_unit(found.curve.x, x),
                          .y = in_unit(found.curve.y, y),
                          .style = SeriesStyle::line_with_points}}};
  Series events{.label = "events", .x = {}, .y = {}, .style = SeriesStyle::points, .colour = 1};
  for (const BaseEvent& event : found.events) {
    events.x.push_back(x.factor * event.quantities[0].value);
    events.y.push_back(y.factor * event.quantities[1].value);
  }
  if (!events.x.empty()) chart.series.push_back(std::move(events));
  return chart;
}

/// The line has gaps where an elasticity is not known or doubtful; doubtful ones are points beside it.
void add_series(Chart& chart, const CaseSensitivity& found, const ParameterSensitivity& p, const DisplayUnit& x) {
  const int colour = static_cast<int>(chart.series.size() % most_lines);
  Series line{.label = short_name(p.parameter), .x = in_unit(found.curve.x, x), .y = {}, .colour = colour};
  for (const Elasticity& e : p.curve) line.y.push_back(e.is_doubtful() ? none : e.value);
  chart.series.push_back(std::move(line));
}

/// Those within the range of the lines.
void add_doubtful(Chart& chart, const CaseSensitivity& found, const DisplayUnit& x) {
  double least = 0.0, most = 1.0;
  for (const Series& line : chart.series)
    for (const double y : line.y)
      if (std::isfinite(y)) least = std::min(least, y), most = std::max(most, y);
  const double beyond = 0.2 * (most - least);
  Series points{.label = "doubtful", .x = {}, .y = {}, .style = SeriesStyle::points, .colour = 7};
  for (const ParameterSensitivity& p : found.parameters)
    for (std::size_t i = 0; i < p.curve.size(); ++i)
      if (const double y = p.curve[i].value; p.curve[i].is_doubtful() && y > least - beyond && y < most + beyond) {
        points.x.push_back(x.factor * found.curve.x[i]);
        points.y.push_back(y);
      }
  if (!points.x.empty()) chart.series.push_back(std::move(points));
}

Chart elasticity_chart(const CaseSensitivity& found, const DisplayUnit& x) {
  Chart chart{.caption = "Elasticity of the force",
              .x = displacement_axis(found, x),
              .y = {.title = "d ln F/d ln p [-]"},
              .series = {}};
  for (const ParameterSensitivity& p : found.parameters)
    if (p.failure.empty() && chart.series.size() < most_lines) add_series(chart, found, p, x);
  add_doubtful(chart, found, x);
  return chart;
}

Table parameters_table(const CaseSensitivity& found) {
  Table table{.caption = "Elasticities of the curve",
              .rows = {{"parameter", "value", "largest", "at", "mean", "error"}},
              .has_header = true};
  for (const ParameterSensitivity& p : found.parameters) {
    const auto overview = p.overview(found.curve);
    if (!overview.largest) continue;
    table.rows.push_back({full_name(p.parameter), in_print(p.parameter.shown(p.parameter.value)),
                          fmt::format("{:.3f}", p.curve[*overview.largest].value),
                          shown(found.curve.x[*overview.largest], "m"), fmt::format("{:.3f}", overview.mean),
                          fmt::format("{:.2g}", overview.error)});
  }
  return table;
}

std::string printed(const Elasticity& elasticity) {
  std::string text = text_of(elasticity);
  if (const std::size_t at = text.find("+-"); at != std::string::npos) text.replace(at, 2, "±");
  return text;
}

/// A row for each figure of an event, a column for each of some parameters.
Table events_table(const CaseSensitivity& found, std::span<const ParameterSensitivity> parameters) {
  Table table{.caption = "Elasticities of events", .rows = {{"event", "figure", "value"}}, .has_header = true};
  for (const ParameterSensitivity& p : parameters) table.rows[0].push_back(short_name(p.parameter));
  for (std::size_t e = 0; e < found.events.size(); ++e)
    for (std::size_t q = 0; q < found.events[e].quantities.size(); ++q) {
      const EventQuantity& quantity = found.events[e].quantities[q];
      table.rows.push_back(
          {found.events[e].event.name(), in_words(quantity.figure), shown(quantity.value, unit_of(quantity.figure))});
      for (const ParameterSensitivity& p : parameters)
        table.rows.back().push_back(p.failure.empty() ? printed(p.events[e][q]) : "-");
    }
  return table;
}

}  // namespace

ReportPage sensitivity_page(const CaseSensitivity& found) {
  const DisplayUnit x = common_unit({{found.curve.x}}, "m");
  ReportPage page{
      .title = fmt::format("{}: {}", found.name, found.title),
      .subtitle = fmt::format("pfdm {}, case {}, sensitivity by {}", found.version, found.hash, found.method),
      .rows = {}};
  page.rows.push_back({.blocks = {force_chart(found, x)}});
  page.rows.push_back({.blocks = {elasticity_chart(found, x)}, .height = 1.3});
  page.rows.push_back({.blocks = {parameters_table(found)}});
  const std::span all(found.parameters);
  for (std::size_t from = 0; from < all.size() && !found.events.empty(); from += columns_of_events)
    page.rows.push_back(
        {.blocks = {events_table(found, all.subspan(from, std::min(columns_of_events, all.size() - from)))}});
  if (!found.remarks.empty())
    page.rows.push_back({.blocks = {TextBlock{.caption = "Remarks", .lines = found.remarks}}});
  return page;
}

void report_sensitivity(const CaseSensitivity& found, Session& session) {
  BrowserExtras extras{.hash = found.hash,
                       .job = session.sensitivity.method == "direct" ? "sensitivity --method direct" : "sensitivity"};
  const auto strongest = std::ranges::find_if(
      found.parameters, [&](const ParameterSensitivity& p) { return p.overview(found.curve).largest.has_value(); });
  if (strongest != found.parameters.end())
    extras.headline.push_back(fmt::format("{} moves the curve most.", full_name(strongest->parameter)));
  write_pages(session.results / "sensitivity", sensitivity_page(found), session, std::move(extras));
}

}  // namespace pfdm
