#include "cases/program/studies/sweep/comparison_page.h"

#include "cases/program/session/page_origin.h"
#include "cases/program/studies/sweep/merged_charts.h"
#include "cases/program/studies/sweep/shown_columns.h"
#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bodies = 4;

Table table_of_runs(std::string caption, std::string corner, const std::vector<ComparedRun>& runs) {
  Table table{.caption = std::move(caption), .rows = {{std::move(corner)}}, .has_header = true};
  for (const ComparedRun& run : runs) table.rows[0].push_back(run.name);
  return table;
}

/// "14.7 N at 49 um", "complete; 100 steps".
std::string words_of(const HeadFigure& figure) {
  if (figure.note.empty()) return figure.value;
  return fmt::format("{}{} {}", figure.value, figure.note.starts_with("at ") ? "" : ";", figure.note);
}

/// What each page says first.
Table headline_table(const std::vector<ComparedRun>& runs) {
  Table table = table_of_runs("At first sight", "", runs);
  std::vector<std::string> labels;
  for (const ComparedRun& run : runs)
    for (const HeadFigure& figure : run.page.figures)
      if (std::ranges::count(labels, figure.label) == 0) labels.push_back(figure.label);
  for (const std::string& label : labels) {
    table.rows.push_back({label});
    for (const ComparedRun& run : runs) {
      const auto found = std::ranges::find(run.page.figures, label, &HeadFigure::label);
      table.rows.back().push_back(found == run.page.figures.end() ? "\u2013" : words_of(*found));
    }
  }
  return table;
}

/// The numbers of the runs' summaries, in one unit each; of those that say what a run cost, or of the others.
Table summary_table(std::string caption, const std::vector<ComparedRun>& runs, bool costs) {
  Table table = table_of_runs(std::move(caption), "", runs);
  std::vector<std::string> names;
  for (const ComparedRun& run : runs)
    if (run.summary)
      for (const auto& [name, ignored] : run.summary->numbers)
        if (is_cost(name) == costs && std::ranges::count(names, name) == 0) names.push_back(name);
  for (const std::string& name : names) {
    std::vector<double> values;
    for (const ComparedRun& run : runs) values.push_back(run.summary ? run.summary->number(name) : std::nan(""));
    if (std::ranges::none_of(values, [](double v) { return std::isfinite(v) && v != 0.0; })) continue;
    const ShownColumn column = shown_column(name, values);
    table.rows.push_back({column.unit.empty() ? column.words : column.title()});
    for (const double value : column.values) table.rows.back().push_back(shown(value));
  }
  return table;
}

bool shares_figures(const Table& table) {
  return std::ranges::any_of(table.rows | std::views::drop(1), [](const auto& row) {
    return std::ranges::count_if(row, [](const std::string& cell) { return cell != "-"; }) > 2;
  });
}

bool shares_curves(const std::vector<PageBlock>& charts) {
  return std::ranges::any_of(charts, [](const PageBlock& block) {
    const auto& series = std::get<Chart>(block).series;
    return std::ranges::any_of(series, [&](const Series& s) { return s.colour != series.front().colour; });
  });
}

/// Of at most four runs: frames at what the first curve of each run has on its x axis, in the unit of the first.
void take_bodies(BrowserPage& page, std::vector<ComparedRun>& runs) {
  std::string unit;
  for (ComparedRun& run : runs) {
    const auto [chart, series] = first_curve(run.page.report);
    if (!run.page.body || chart == nullptr || series->x.empty() || page.bodies.size() == most_bodies) continue;
    const auto [words, own] = words_and_unit(chart->x.title);
    if (page.bodies.empty()) page.bodies_axis = {.words = words.substr(0, words.find(" of ")), .unit = unit = own};
    const auto factor = factor_between(own, unit);
    if (!factor) continue;
    NamedBody body{.name = run.name, .steps = std::move(run.page.steps), .at = {}, .body = {}};
    for (const Index row : run.page.body->steps)  // a run that goes on may have gained a step since the curve was read
      body.at.push_back(*factor * series->x[std::min(as_size(row), series->x.size() - 1)]);
    body.body = std::move(*run.page.body);
    page.bodies.push_back(std::move(body));
  }
  if (page.bodies.size() == 1) page.bodies.clear();
}

void tell_of_runs(BrowserPage& page, const std::vector<ComparedRun>& runs) {
  for (const ComparedRun& run : runs) {
    if (!run.page.headline.empty()) page.headline.push_back(fmt::format("{}: {}", run.name, run.page.headline.front()));
    for (const std::string& warning : run.page.warnings)
      page.warnings.push_back(fmt::format("{}: {}", run.name, warning));
    page.origin.emplace_back(run.name, run.page.report.title);
    for (const auto& [name, value] : run.page.origin) page.origin.emplace_back("", fmt::format("{}: {}", name, value));
  }
}

/// But for what an earlier comparison that was killed at once may have left.
bool is_as_good_as_empty(const fs::path& folder) {
  return std::ranges::all_of(fs::directory_iterator(folder), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name == owned_folder_mark || is_partial_name(name);
  });
}

/// Empty, or an earlier comparison's.
void require_own_folder(const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError(fmt::format("{} is a file, not a folder; choose another with --output", folder.string()));
  if (!fs::exists(folder) || fs::exists(folder / compared_file) || is_as_good_as_empty(folder)) return;
  throw InputError(
      fmt::format("{} holds files that are not of a comparison: choose another folder with --output, one that is empty "
                  "or that has {}",
                  folder.string(), compared_file));
}

std::string record_of(const std::vector<ComparedRun>& runs, const std::string& version) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ComparedRun& run : runs)
    list.push_back({{"name", run.name},
                    {"results", fs::absolute(run.results).lexically_normal().string()},
                    {"case_hash", run.summary ? run.summary->case_hash : ""}});
  const nlohmann::ordered_json json{{"pfdm", version}, {"runs", std::move(list)}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

BrowserPage comparison_page(std::vector<ComparedRun> runs, const std::string& version, const std::string& command) {
  std::vector<NamedReport> reports;
  std::vector<std::string> names;
  for (const ComparedRun& run : runs) {
    reports.push_back({run.name, &run.page.report});
    names.push_back(run.name);
  }
  BrowserPage page{.report = {.title = fmt::format("{} runs side by side", runs.size()),
                              .subtitle = fmt::format("pfdm {}: {}", version, fmt::join(names, ", ")),
                              .rows = {}},
                   .headline = {},
                   .figures = {},
                   .warnings = {},
                   .origin = {},
                   .command = command,
                   .case_text = {},
                   .steps = {},
                   .body = std::nullopt};
  std::vector<PageBlock> charts = merged_charts(reports);
  Table figures = summary_table("Figures", runs, false);
  if (!shares_curves(charts) && !shares_figures(figures))
    throw InputError(fmt::format("report: {} have no curve and no figure in common", fmt::join(names, ", ")));
  tell_of_runs(page, runs);
  const auto add = [&](PageBlock block) { page.report.rows.push_back({.blocks = {std::move(block)}}); };
  page.first = {headline_table(runs), differing_keys(runs)};
  for (PageBlock& chart : charts) add(std::move(chart));
  add(std::move(figures));
  add(summary_table("What it took", runs, true));
  take_bodies(page, runs);
  return page;
}

void report_compared(const std::vector<std::string>& places, Session& session) {
  require_own_folder(session.results);
  std::vector<ComparedRun> runs = open_compared(places, session);
  std::string command = called_as() + " report";
  for (const std::string& place : places) command += " " + shell_word(place);
  command += " --output " + shell_word(session.results.string());
  const std::string record = record_of(runs, session.version);
  const BrowserPage page = comparison_page(std::move(runs), session.version, command);
  const FolderLock lock(session.results);
  write_file(session.results / compared_file, record);
  write_browser_page(session.results, page);
  session.log.say(fmt::format("open in a browser: {}", (session.results / "index.html").string()));
}

}  // namespace pfdm
