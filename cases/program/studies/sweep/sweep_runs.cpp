#include "cases/program/studies/sweep/sweep_runs.h"

#include "cases/program/studies/sweep/compared_runs.h"
#include "cases/program/studies/sweep/merged_charts.h"
#include "cases/program/studies/sweep/shown_columns.h"
#include "cases/program/studies/sweep/sweep_changes.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_curves = 200, most_points = 150;

/// What sweep.csv says of a run: its folder, and a link to it by its values; or why it has none.
struct RunPlace {
  fs::path folder;  ///< empty: none
  std::string label, note;
};

RunPlace place_of(const CsvTable& table, std::size_t i, const fs::path& results) {
  const std::string mark = fmt::format("run {}: ", i + 1);
  RunPlace place{.folder = {}, .label = fmt::format("run {}", i + 1), .note = {}};
  for (const std::string& comment : table.comments) {
    const std::size_t at = comment.find(mark);
    if (at == std::string::npos || comment.find_first_not_of(' ') != at) continue;
    const std::string told = comment.substr(at + mark.size()), folder = told.substr(0, told.find(", "));
    std::error_code none;
    if (!folder.starts_with("runs/") || !fs::is_directory(results / folder, none)) {
      place.note = told;
      continue;
    }
    place.folder = results / folder;
    const std::size_t link = told.find("runs_by_value/");
    if (link != std::string::npos) place.label = told.substr(link + std::string("runs_by_value/").size());
  }
  return place;
}

/// At most so many points: the first, the last and evenly many between.
Series thinned(const std::vector<double>& x, const std::vector<double>& y, double x_factor, double y_factor) {
  Series curve{.label = {}, .x = {}, .y = {}};
  const std::size_t n = std::min(x.size(), most_points);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = n == x.size() ? k : k * (x.size() - 1) / (n - 1);
    curve.x.push_back(x_factor * x[i]);
    curve.y.push_back(y_factor * y[i]);
  }
  return curve;
}

/// The first curve of a page that tells of steps, or else the last series of its first chart.
std::pair<const Chart*, const Series*> curve_of(const ReportPage& page) {
  if (const auto found = first_curve(page); found.first != nullptr) return found;
  for (const PageRow& row : page.rows)
    for (const PageBlock& block : row.blocks)
      if (const auto* chart = std::get_if<Chart>(&block); chart != nullptr && !chart->series.empty())
        return {chart, &chart->series.back()};
  return {nullptr, nullptr};
}

/// Adds the curve of a run in the units of the first; none where that cannot be.
void add_curve(RunSet& runs, const fs::path& folder, const Session& session) {
  runs.curves.push_back({.label = {}, .x = {}, .y = {}});
  if (folder.empty() || runs.curves.size() > most_curves) return;
  try {
    const CasePage page = page_of_results(folder, session);
    const auto [chart, series] = curve_of(page.report);
    if (chart == nullptr) return;
    if (runs.x_title.empty()) runs.x_title = chart->x.title, runs.y_title = chart->y.title;
    const auto factor = [](const std::string& from, const std::string& to) {
      return factor_between(words_and_unit(from).second, words_and_unit(to).second);
    };
    const auto x = factor(chart->x.title, runs.x_title), y = factor(chart->y.title, runs.y_title);
    if (x && y) runs.curves.back() = thinned(series->x, series->y, *x, *y);
  } catch (const InputError&) {  // of results that somebody has touched: the table still has its figures
  }
}

}  // namespace

RunSet sweep_runs(const CsvTable& table, const Session& session) {
  RunSet runs{.labels = {}, .notes = {}, .columns = {}, .x_title = {}, .y_title = {}, .curves = {}};
  const std::size_t converged = table.find("converged");
  for (std::size_t j = 1; j < table.names.size(); ++j) {
    if (j == converged) continue;
    ShownColumn column = shown_column(table, j);
    runs.columns.push_back({.words = column.names.empty() ? std::move(column.words) : column.title(),
                            .unit = std::move(column.unit),
                            .values = std::move(column.values),
                            .is_key = j < converged});
  }
  const bool is_of_changes = table.names.size() > 1 && table.names[1] == change_column;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    RunPlace place = place_of(table, i, session.results);
    if (is_of_changes) place.label = shown_column(table, 1).cell(i);
    add_curve(runs, place.folder, session);
    runs.labels.push_back(std::move(place.label));
    runs.notes.push_back(std::move(place.note));
  }
  if (std::ranges::all_of(runs.curves, [](const Series& curve) { return curve.x.empty(); })) runs.curves.clear();
  return runs;
}

}  // namespace pfdm
