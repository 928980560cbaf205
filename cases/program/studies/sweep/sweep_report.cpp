#include "cases/program/studies/sweep/sweep_report.h"

#include "cases/program/session/report_parts.h"
#include "cases/program/studies/sweep/shown_columns.h"
#include "cases/program/studies/sweep/sweep_changes.h"
#include "cases/program/studies/sweep/sweep_runs.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "postproc/page/page_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_runs_shown = 40, most_figures = 6, most_columns = 3, most_series = 8, longest_label = 24;

/// Numbers of columns: what the sweep changes, and figures that came out.
struct SweepColumns {
  std::vector<std::size_t> parameters, figures;
};

SweepColumns columns_of(const CsvTable& table) {
  SweepColumns columns;
  const std::size_t converged = table.find("converged");
  for (std::size_t j = 1; j < converged; ++j) columns.parameters.push_back(j);
  const auto add = [&](std::size_t j) {
    if (columns.figures.size() < most_figures && varies(table.columns[j]) &&
        std::ranges::count(columns.figures, j) == 0)
      columns.figures.push_back(j);
  };
  for (const std::size_t j : headline_columns(table)) add(j);
  for (std::size_t j = converged + 1; j < table.names.size(); ++j) add(j);
  return columns;
}

Table runs_table(const CsvTable& table, const SweepColumns& columns) {
  std::vector<std::size_t> all = columns.parameters;
  all.insert(all.end(), columns.figures.begin(),
             columns.figures.begin() + std::min(columns.figures.size(), most_columns));
  const std::size_t n = std::min(table.n_rows(), most_runs_shown);
  Table shown_table{.caption = n < table.n_rows()
                                   ? fmt::format("{}, the first {} of {}", runs_caption, n, table.n_rows())
                                   : std::string(runs_caption),
                    .rows = {{"run"}},
                    .has_header = true};
  for (std::size_t i = 0; i < n; ++i) shown_table.rows.push_back({fmt::format("{}", i + 1)});
  for (const std::size_t j : all) {
    const ShownColumn column = shown_column(table, j);
    shown_table.rows[0].push_back(column.names.empty() ? column.title() : column.words);
    for (std::size_t i = 0; i < n; ++i) shown_table.rows[i + 1].push_back(column.cell(i));
  }
  return shown_table;
}

/// The runs by the value of what is changed besides; of too many values, or none, all together.
std::map<double, std::vector<std::size_t>> groups(const CsvTable& table, const SweepColumns& columns, std::size_t x) {
  std::map<double, std::vector<std::size_t>> by_value;
  const bool two = columns.parameters.size() == 2;
  const std::size_t other = two && columns.parameters[0] == x ? columns.parameters[1] : columns.parameters[0];
  for (std::size_t i = 0; i < table.n_rows(); ++i) by_value[two ? table.columns[other][i] : 0.0].push_back(i);
  if (by_value.size() <= most_series) return by_value;
  by_value.clear();
  for (std::size_t i = 0; i < table.n_rows(); ++i) by_value[0.0].push_back(i);
  return by_value;
}

Chart figure_chart(const CsvTable& table, const SweepColumns& columns, std::size_t x, std::size_t figure) {
  const ShownColumn across = shown_column(table, x), up = shown_column(table, figure);
  Chart chart{.caption = up.words, .x = {.title = across.title()}, .y = {.title = up.title()}, .series = {}};
  const auto by_value = groups(table, columns, x);
  for (const auto& [value, runs] : by_value) {
    std::vector<std::pair<double, double>> points;
    for (const std::size_t i : runs)
      if (std::isfinite(up.values[i])) points.emplace_back(across.values[i], up.values[i]);
    std::ranges::sort(points);
    Series series{.label = {}, .x = {}, .y = {}, .style = SeriesStyle::line_with_points};
    if (by_value.size() > 1) {
      const std::size_t other = columns.parameters[0] == x ? columns.parameters[1] : columns.parameters[0];
      const ShownColumn column = shown_column(table, other);
      const std::string cell = column.cell(runs.front());
      series.label = cell.size() <= longest_label
                         ? fmt::format("{} {} {}", column.words, cell, column.unit)
                         : fmt::format("{} {}", column.words, table.columns[other][runs.front()]);
    } else if (columns.parameters.size() > 1) {
      series.style = SeriesStyle::points;
    }
    for (const auto& [at, y] : points) {
      series.x.push_back(at);
      series.y.push_back(y);
    }
    series.colour = static_cast<int>(chart.series.size());
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// "3 runs, 2 of them converged"
std::string words_of_runs(const CsvTable& table) {
  return fmt::format("{} run{}, {} of them converged", table.n_rows(), table.n_rows() == 1 ? "" : "s",
                     std::ranges::count(table.column("converged"), 1.0));
}

/// What the comments tell beside what changes do, which has a block of its own.
std::vector<PageRow> comments_row(const CsvTable& table) {
  TextBlock block{.caption = "Folders, words, and runs that did not converge", .lines = {}};
  for (const std::string& comment : table.comments)
    if (block.lines.size() < most_runs_shown && !told_change(comment)) block.lines.push_back(comment);
  if (block.lines.empty()) return {};
  return {PageRow{.blocks = {std::move(block)}}};
}

ReportPage page_of(const CsvTable& table, const std::string& title, const std::string& version) {
  const SweepColumns columns = columns_of(table);
  ReportPage page{.title = title,
                  .subtitle = fmt::format("pfdm {}, sweep of {}", version, words_of_runs(table)),
                  .rows = {PageRow{.blocks = {runs_table(table, columns)}}}};
  std::vector<std::string> changes = told_changes(table);
  for (std::string& line : changes) line = in_print(std::move(line));
  if (!changes.empty())
    page.rows.insert(page.rows.begin(),
                     PageRow{.blocks = {TextBlock{.caption = "What each change does", .lines = std::move(changes)}}});
  std::vector<PageBlock> charts;
  for (const std::size_t figure : columns.figures)
    for (const std::size_t x : columns.parameters)
      if (varies(table.columns[x]) && charts.size() < most_figures)
        charts.emplace_back(figure_chart(table, columns, x, figure));
  for (PageRow& row : in_pairs(std::move(charts))) page.rows.push_back(std::move(row));
  for (PageRow& row : comments_row(table)) page.rows.push_back(std::move(row));
  return page;
}

}  // namespace

bool has_own_run(const fs::path& results) {
  return fs::exists(results / summary_file) || fs::exists(results / "checkpoint.bin") ||
         fs::exists(results / "fit.json");
}

void report_sweep(const std::string& title, Session& session) {
  const fs::path folder = session.results / "report" / (has_own_run(session.results) ? "sweep" : "");
  const CsvTable table = read_csv(session.results / sweep_file, {.has_gaps = true});
  std::vector<std::string> headline{fmt::format("The sweep has {}.", words_of_runs(table))};
  if (std::string most = most_of_changes(table); !most.empty()) headline.push_back(std::move(most));
  write_pages(folder, page_of(table, title, session.version), session,
              {.headline = std::move(headline), .runs = sweep_runs(table, session)});
}

}  // namespace pfdm
