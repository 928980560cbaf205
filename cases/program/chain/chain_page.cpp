#include "cases/program/chain/chain_page.h"

#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

std::string text_of(double value, const std::string& unit) { return unit.empty() ? shown(value) : shown(value, unit); }

std::string interval_of(const ShownFigure& figure) {
  if (figure.interval.size() != 2 || std::isnan(figure.interval[0]) || std::isnan(figure.interval[1])) return "";
  return fmt::format("{} to {}", text_of(figure.interval[0], figure.unit), text_of(figure.interval[1], figure.unit));
}

Table steps_table(const ChainRecord& record) {
  Table table{.caption = "Steps", .rows = {{"", "step", "job", "time", "verdict"}}, .has_header = true};
  for (std::size_t i = 0; i < record.steps.size(); ++i) {
    const DoneStep& step = record.steps[i];
    table.rows.push_back({std::to_string(i + 1), step.name, step.does, fmt::format("{:.1f} s", step.wall_seconds),
                          step.verdict.empty() ? "-" : step.verdict});
  }
  return table;
}

Table taken_table(const ChainRecord& record) {
  Table table{.caption = "What the steps take from earlier ones",
              .rows = {{"step", "value", "from", "number"}},
              .has_header = true};
  for (const DoneStep& step : record.steps) {
    for (const TakenNumber& number : step.taken)
      table.rows.push_back({step.name, number.into, fmt::format("{}: {}", number.from, number.key),
                            fmt::format("{:.6g}", number.value)});
    for (const std::string& file : step.files) table.rows.push_back({step.name, "file", file, ""});
  }
  return table;
}

Table figures_table(const ChainRecord& record) {
  Table table{.caption = "Results", .rows = {{"step", "quantity", "value", "interval"}}, .has_header = true};
  for (const DoneStep& step : record.steps)
    for (const ShownFigure& figure : step.figures)
      table.rows.push_back({step.name, figure.says, text_of(figure.value, figure.unit), interval_of(figure)});
  return table;
}

}  // namespace

ReportPage chain_page(const ChainRecord& record, const std::string& title) {
  ReportPage page{.title = title,
                  .subtitle = fmt::format("case {}; {}; pfdm {}", record.case_name, record.status, record.version),
                  .rows = {{.blocks = {steps_table(record)}}}};
  for (Table table : {figures_table(record), taken_table(record)})
    if (table.rows.size() > 1) page.rows.push_back({.blocks = {std::move(table)}});
  return page;
}

}  // namespace pfdm
