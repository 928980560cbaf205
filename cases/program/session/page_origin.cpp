#include "cases/program/session/page_origin.h"

#include "cases/program/input/config/result_number.h"
#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/terminal/external_program.h"
#include "physics/error.h"
#include "postproc/curves/summary.h"
#include "postproc/files/text_file.h"
#include "postproc/fits/fit_json.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<std::pair<std::string, std::string>>;

/// As in "2026-01-31 12:00 UTC".
std::string time_of(const fs::path& file) {
  const auto when = std::chrono::file_clock::to_sys(fs::last_write_time(file));
  return fmt::format(
      "{:%Y-%m-%d %H:%M} UTC",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::seconds>(when))));
}

/// The line of a log that tells version, instruction set, threads; empty if there is none.
std::string head_of(const fs::path& log) {
  const std::string content = read_file(log);
  for (std::string_view rest = content; !rest.empty();) {
    const std::string_view line = take_line(rest);
    if (const std::size_t at = line.find("pfdm ");
        at != std::string_view::npos && line.find(" (") != std::string_view::npos)
      return std::string(line.substr(at));
  }
  return {};
}

Rows origin_of(const fs::path& results, const std::string& hash) {
  Rows rows;
  const auto add = [&](std::string name, std::string value) { rows.emplace_back(std::move(name), std::move(value)); };
  for (const char* log : {"run.log", "fit.log"})
    if (fs::exists(results / log))
      if (std::string head = head_of(results / log); !head.empty()) add(log, std::move(head));
  if (fs::exists(results / summary_file)) {
    if (const auto summary = read_summary(results / summary_file)) {
      add("status", summary->status);
      if (const double wall = summary->number("wall_seconds"); std::isfinite(wall))
        add("time", shown_seconds(wall) + " s");
      if (!summary->processor.empty()) add("computed on", summary->processor);
      add("hash of the case", summary->case_hash);
    }
    add("ended", time_of(results / summary_file));
  } else if (!hash.empty()) {
    add("hash of the case", hash);
  }
  const std::string here = processor_name();
  add("page made on", fmt::format("{}, {} threads", here.empty() ? "a processor not known" : here,
                                  std::thread::hardware_concurrency()));
  add("results", results.string());
  return rows;
}

std::string command_of(const fs::path& results, const std::string& given) {
  const fs::path file = case_of(results);
  if (file.empty()) return {};
  const bool is_default = results.filename() == "results" && fs::exists(results.parent_path() / "case.toml");
  std::string_view job = "run";
  if (!fs::exists(results / summary_file) && fs::exists(results / "fit.json")) job = "fit";
  if (!fs::exists(results / summary_file) && fs::exists(results / "sweep.csv")) job = "sweep";
  if (!given.empty()) job = given;
  return fmt::format("{} {} {}", called_as(), job, shell_word((is_default ? results.parent_path() : file).string()));
}

/// Without the unit that a name may end with: "k3" of "k3_N_per_m3".
std::string symbol_of(const std::string& name, std::string unit) {
  if (unit == "1") return name;
  std::erase_if(unit, [](char c) { return c == '(' || c == ')'; });
  const std::string in_name = in_names(unit), end = in_name.starts_with("1_per_") ? in_name.substr(1) : "_" + in_name;
  return name.size() > end.size() && name.ends_with(end) ? name.substr(0, name.size() - end.size()) : name;
}

/// Verdict and estimates.
void add_fit(BrowserPage& page, const FitReport& fit) {
  page.headline.push_back(fmt::format("The fit is {}.", verdict_text(fit.found)));
  for (const FittedParameter& p : fit.found.parameters) {
    const ScaledUnit unit = unit_of_estimate(p.estimate, p.unit);
    const bool has_interval = std::isfinite(p.lower) && std::isfinite(p.upper);
    page.figures.push_back({.label = symbol_of(p.name, p.unit),
                            .value = in_print(fmt::format("{:.4g} {}", unit.factor * p.estimate, unit.name)),
                            .note = has_interval
                                        ? interval_text(unit.factor * p.lower, unit.factor * p.upper, fit.confidence, 4)
                                        : "no interval"});
  }
}

/// Of a page that has no figures of its own: the first rows of the table that has them.
std::vector<HeadFigure> figures_of_tables(const ReportPage& report) {
  constexpr std::size_t most = 6;
  std::vector<HeadFigure> figures;
  for (const PageRow& row : report.rows)
    for (const PageBlock& block : row.blocks) {
      const auto* table = std::get_if<Table>(&block);
      if (table == nullptr || !figures.empty()) continue;
      const bool of_chain = table->caption == "Results";  // step, quantity, value, interval
      const bool of_run = std::ranges::any_of(std::array{"Figures", "Closest isotropic", "Run"},
                                              [&](const char* name) { return table->caption.starts_with(name); });
      for (const auto& cells : table->rows) {
        if (figures.size() == most || (table->has_header && &cells == &table->rows.front())) continue;
        if (of_chain && cells.size() == 4)
          figures.push_back({.label = cells[1],
                             .value = cells[2],
                             .note = cells[3].empty() ? cells[0] : fmt::format("{}; step {}", cells[3], cells[0])});
        if (of_run && cells.size() == 2) figures.push_back({.label = cells[0], .value = cells[1], .note = {}});
      }
    }
  return figures;
}

bool is_told_elsewhere(const PageBlock& block, const BrowserExtras& extras) {
  if (const auto* text = std::get_if<TextBlock>(&block)) return text->caption == warnings_caption;
  if (const auto* table = std::get_if<Table>(&block)) return extras.runs && table->caption.starts_with(runs_caption);
  if (std::holds_alternative<Chart>(block)) return extras.runs.has_value();  // any figure over any value is there
  const auto* picture = std::get_if<Picture>(&block);
  return picture != nullptr && extras.body && picture->caption.starts_with("Damage, plane");
}

}  // namespace

std::string called_as() {
  const char* launcher = std::getenv("PFDM_LAUNCHER");
  return launcher != nullptr ? launcher : "pfdm";
}

fs::path case_of(const fs::path& results) {
  for (const fs::path& file : {results / "case.toml", results.parent_path() / "case.toml"})
    if (fs::exists(file)) return file;
  return {};
}

std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./+=:,@%").find(c) != std::string_view::npos;
  };
  return !word.empty() && std::ranges::all_of(word, is_plain) ? word : quoted(word);
}

BrowserPage browser_page(ReportPage report, const fs::path& results, BrowserExtras extras) {
  for (PageRow& row : report.rows)
    std::erase_if(row.blocks, [&](const PageBlock& block) { return is_told_elsewhere(block, extras); });
  if (!extras.more.empty()) report.rows.push_back({.blocks = std::move(extras.more)});
  BrowserPage page{.report = std::move(report),
                   .headline = std::move(extras.headline),
                   .figures = std::move(extras.figures),
                   .warnings = {},
                   .origin = origin_of(results, extras.hash),
                   .command = command_of(results, extras.job),
                   .case_text = {},
                   .steps = std::move(extras.steps),
                   .body = std::move(extras.body),
                   .beside = std::move(extras.beside),
                   .runs = std::move(extras.runs)};
  for (const char* log : {"run.log", "fit.log"})
    for (std::string& warning : warnings_of(results / log)) page.warnings.push_back(std::move(warning));
  if (const fs::path file = case_of(results); !file.empty()) page.case_text = read_file(file);
  if (!extras.hash.empty() && fs::exists(results / "fit.json"))
    if (const FitReport fit = read_fit_json(results / "fit.json"); fit.case_hash == extras.hash) add_fit(page, fit);
  for (std::string& sentence : page.headline) sentence = in_print(std::move(sentence));
  if (page.figures.empty()) page.figures = figures_of_tables(page.report);
  if (page.headline.empty() && fs::exists(results / summary_file))
    if (const auto summary = read_summary(results / summary_file))
      page.headline.push_back(fmt::format("The run is {}.", summary->status));
  return page;
}

}  // namespace pfdm
