#include "cases/program/listing.h"

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/kinds.h"
#include "postproc/curves/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace pfdm {
namespace {

void list_table(std::ostream& out, const LawTable& table) {
  out << table.heading << '\n';
  for (const auto& [name, description] : table.rows) out << fmt::format("  {:<22} {}\n", name, description);
}

namespace fs = std::filesystem;

std::vector<fs::path> cases_in(const fs::path& directory) {
  std::vector<fs::path> cases;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(directory, unreadable))
    if (fs::exists(entry.path() / "case.toml")) cases.push_back(entry.path());
  std::ranges::sort(cases);
  return cases;
}

/// As in "70 s" or "12 min"; of the last complete run here.
std::string time_of(const fs::path& directory) {
  const auto summary = read_summary(directory / "results" / summary_file);
  if (!summary || summary->status != "complete") return "";
  const double seconds = summary->number("wall_seconds");
  if (std::isnan(seconds)) return "";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 300.0) return fmt::format("{:.0f} s", seconds);
  return seconds < 3.0 * 3600.0 ? fmt::format("{:.0f} min", seconds / 60.0) : fmt::format("{:.0f} h", seconds / 3600.0);
}

struct CaseLine {
  std::string kind, name, time, title;
};

CaseLine line_of(const fs::path& directory) {
  CaseLine line{.kind = "?", .name = directory.filename().string(), .time = "", .title = ""};
  try {
    const ConfigTable root = open_case(directory).config.root();
    line = {.kind = root.string("kind"), .name = line.name, .time = time_of(directory), .title = root.string("title")};
  } catch (const InputError& error) {
    line.title = fmt::format("(cannot be read: {})", error.what());
  }
  return line;
}

}  // namespace

fs::path shipped_cases() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed = program.parent_path().parent_path() / "share/pfdm/cases";
  return fs::is_directory(installed, none) ? installed : fs::path(PFDM_CASES_DIR);
}

void list_cases(const std::filesystem::path& cases_directory, std::ostream& out) {
  if (!std::filesystem::is_directory(cases_directory))
    throw InputError(fmt::format("{}: there is no such directory of cases", cases_directory.string()));
  std::vector<CaseLine> lines;
  for (const fs::path& directory : cases_in(cases_directory)) lines.push_back(line_of(directory));
  std::ranges::stable_sort(lines, {}, &CaseLine::kind);
  std::size_t width = 0;
  for (const CaseLine& line : lines) width = std::max(width, line.name.size());
  const bool timed = std::ranges::any_of(lines, [](const CaseLine& line) { return !line.time.empty(); });
  for (const CaseLine& line : lines)
    out << fmt::format("{:<{}}  {:<13}  {:>{}}{}\n", line.name, width, line.kind, line.time, timed ? 7 : 0,
                       (timed ? "  " : "") + line.title);
}

std::optional<std::string> nearest_case(const fs::path& where, const fs::path& cases_directory) {
  const fs::path plain = where.has_filename() ? where : where.parent_path();
  const fs::path beside = plain.has_parent_path() ? plain.parent_path() : fs::path(".");
  std::vector<fs::path> cases = cases_in(beside);
  std::ranges::copy(cases_in(cases_directory), std::back_inserter(cases));
  std::vector<std::string> names;
  names.reserve(cases.size());
  for (const fs::path& directory : cases) names.push_back(directory.filename().string());
  const auto name = nearest(plain.filename().string(), names);
  if (!name) return std::nullopt;
  const fs::path& found = cases[std::ranges::find(names, *name) - names.begin()];
  const fs::path seen = fs::proximate(found);
  return (!seen.empty() && *seen.begin() != ".." ? seen : found).string();
}

void list_laws(std::ostream& out) {
  list_table(out, law_table("kinds of case (kind)", case_kinds()));
  for (const CaseKind& kind : case_kinds()) {
    if (kind.laws == nullptr) continue;
    out << fmt::format("\n{}: {}\n", kind.name, kind.description);
    for (const LawTable& table : kind.laws()) list_table(out, table);
  }
  if (case_kinds().size() < std::size(all_kind_names))
    out << "\nKinds of case that this program was built without, until one of them is used: cases/README.md\n";
}

}  // namespace pfdm
