#include "cases/program/session/report_parts.h"

#include "cases/program/input/case_files/off_defaults.h"
#include "cases/program/session/page_origin.h"
#include "cases/program/session/runnable_case.h"
#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/other_case.h"
#include "postproc/files/text_file.h"
#include "postproc/page/page_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {

std::vector<double> in_unit(std::span<const double> values, const DisplayUnit& unit) {
  std::vector<double> shown;
  for (const double value : values) shown.push_back(unit.factor * value);
  return shown;
}

DisplayUnit common_unit(std::span<const std::vector<double>> columns, std::string_view si_unit) {
  double largest = 0.0;
  for (const auto& column : columns)
    for (const double value : column)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return display_unit(largest, si_unit);
}

void add_series(Chart& chart, const std::vector<double>& x, std::span<const std::vector<double>> columns,
                std::span<const std::string_view> names, const DisplayUnit& unit) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    chart.series.push_back(
        {.label = std::string(names[i]), .x = x, .y = in_unit(columns[i], unit), .colour = static_cast<int>(i)});
}

std::vector<PageRow> in_pairs(std::vector<PageBlock> blocks) {
  std::vector<PageRow> rows;
  for (PageBlock& block : blocks) {
    if (rows.empty() || rows.back().blocks.size() == 2) rows.push_back({.blocks = {}});
    const bool is_picture = std::holds_alternative<Picture>(block);
    rows.back().blocks.push_back(std::move(block));
    if (is_picture) rows.back().height = 1.25;
  }
  return rows;
}

std::vector<std::string> warnings_of(const std::filesystem::path& log) {
  if (!std::filesystem::exists(log)) return {};
  const std::string content = read_file(log);
  constexpr std::string_view mark = " warning: ";
  std::vector<std::string> warnings;
  for (std::string_view rest = content; !rest.empty();) {
    const std::string_view line = take_line(rest);
    const std::size_t at = line.find(mark);
    if (at == std::string_view::npos) continue;
    std::string warning(line.substr(at + mark.size()));
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(std::move(warning));
  }
  return warnings;
}

std::vector<PageRow> warnings_row(const std::filesystem::path& log, std::size_t limit) {
  std::vector<std::string> warnings = warnings_of(log);
  if (warnings.empty()) return {};
  const std::size_t n = warnings.size();
  if (n > limit) {
    warnings.resize(limit);
    warnings.push_back(fmt::format("and {} more in {}", n - limit, log.filename().string()));
  }
  return {PageRow{.blocks = {TextBlock{.caption = std::string(warnings_caption), .lines = std::move(warnings)}}}};
}

void require_case(const std::filesystem::path& file, const std::string& found, const std::string& due) {
  if (found != due)
    throw OtherCase(
        fmt::format("{}: it belongs to another case, or to this one before it was changed (hash {}, expected {})",
                    file.string(), found, due));
}

void remove_report(const std::filesystem::path& results) {
  const std::filesystem::path folder = results / "report";
  std::error_code ignored;
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (entry.is_directory(ignored)) folders.push_back(entry.path());
  folders.push_back(folder);
  for (const std::filesystem::path& of : folders) {
    for (const char* file : {"report.pdf", "report.png", "index.html"}) std::filesystem::remove(of / file, ignored);
    remove_leftovers(of);
    std::filesystem::remove(of, ignored);  // unless there is something else in it
  }
}

std::vector<std::vector<std::string>> keys_off_defaults(const Session& session) {
  const std::filesystem::path file = case_of(session.results);
  if (file.empty() || session.read_case == nullptr) return {};
  std::vector<std::vector<std::string>> rows;
  try {
    const CaseFile read = open_case(file);
    session.read_case(read);
    for (const OffDefault& key : off_defaults(read.config)) rows.push_back({key.path, key.value, key.otherwise});
  } catch (const InputError&) {  // as one of an earlier version
  }
  return rows;
}

void write_pages(const std::filesystem::path& folder, const ReportPage& page, Session& session, BrowserExtras extras) {
  write_page(folder, page);
  session.log.say(fmt::format("written to {} and report.png", (folder / "report.pdf").string()));
  BrowserPage in_browser = browser_page(page, session.results, std::move(extras));
  in_browser.keys = keys_off_defaults(session);
  write_browser_page(folder, in_browser);
  session.log.say(fmt::format("open in a browser: {}", (folder / "index.html").string()));
}

void write_report(CasePage page, Session& session) {
  write_pages(session.results / "report", page.report, session, std::move(page.extras));
}

}  // namespace pfdm
