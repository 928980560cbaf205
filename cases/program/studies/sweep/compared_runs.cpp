#include "cases/program/studies/sweep/compared_runs.h"

#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/session/page_origin.h"
#include "cases/program/session/runnable_case.h"
#include "cases/program/studies/sweep/sweep_report.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// The case as it ran where its results have kept it.
CaseFile case_as_it_ran(const std::string& place) {
  if (!fs::exists(place)) throw InputError(fmt::format("{}: there is no such case or folder of results", place));
  CaseFile file = open_case(place);
  const fs::path results = own_results(file);
  const bool has_kept = file.kept_in.empty() && fs::exists(results / "case.toml") && fs::exists(results / "run.log");
  return has_kept ? open_case(results) : file;
}

void require_run(const std::string& place, const fs::path& results) {
  if (fs::exists(results / sweep_file) && !has_own_run(results))
    throw InputError(
        fmt::format("{}: these are the results of a sweep, which pfdm report {} sets side by side; name single runs of "
                    "it, as {}/runs_by_value/...",
                    place, place, results.string()));
  if (!fs::exists(results))
    throw InputError(fmt::format("{}: there are no results; pfdm run {} makes them", results.string(), place));
}

CasePage page_of_case(const CaseFile& file, const fs::path& results, const Session& session) {
  const RunnableCase runnable = session.read_case(file);
  if (!runnable.page) throw InputError(fmt::format("{}: this kind of case has no page", results.string()));
  Session own = session;
  own.results = results;
  return runnable.page(own);
}

ComparedRun open_run(const std::string& place, const Session& session) {
  CaseFile file = case_as_it_ran(place);
  const fs::path results = own_results(file);
  require_run(place, results);
  CasePage page = page_of_case(file, results, session);
  auto summary = fs::exists(results / summary_file) ? read_summary(results / summary_file) : std::nullopt;
  return {.name = {},
          .results = results,
          .file = std::move(file),
          .page = browser_page(std::move(page.report), results, std::move(page.extras)),
          .summary = std::move(summary)};
}

std::vector<std::string> parts_of(const std::string& place) {
  std::vector<std::string> parts;
  for (const fs::path& part : fs::absolute(place).lexically_normal())
    if (!part.empty()) parts.push_back(part.string());
  return parts;
}

/// "length=4mm" of "toughness=80J_m2,length=4mm" where all have the toughness, and likewise at the ends.
void drop_common_values(std::vector<std::string>& names) {
  const auto all_share = [&](const auto& part_of) {
    const std::string first = part_of(names[0]);
    return first.find('=') != std::string::npos &&
           std::ranges::all_of(names, [&](const std::string& name) { return part_of(name) == first; });
  };
  while (all_share([](const std::string& name) { return name.substr(0, name.find(',') + 1); }))
    for (std::string& name : names) name.erase(0, name.find(',') + 1);
  while (all_share([](const std::string& name) { return name.substr(std::min(name.rfind(','), name.size())); }))
    for (std::string& name : names) name.resize(name.rfind(','));
}

/// Every text and number of a case, by its path, as people read them.
std::map<std::string, std::string> values_of(const CaseFile& file) {
  constexpr std::size_t longest = 80;
  std::map<std::string, std::string> values;
  for_each_value(parse_toml(file.text, "case.toml"), [&](const std::string& path, const TomlValue& value) {
    if (path == "title" || std::holds_alternative<TomlArray>(value.value) ||
        std::holds_alternative<TomlTable>(value.value))
      return;
    const auto* text = std::get_if<std::string>(&value.value);
    std::string words = text != nullptr ? *text : written(value);
    if (words.size() > longest) words = shown(value);
    values[path] = std::move(words);
  });
  return values;
}

}  // namespace

CasePage page_of_results(const fs::path& folder, const Session& session) {
  return page_of_case(open_case(folder), folder, session);
}

std::vector<std::string> short_names(const std::vector<std::string>& places) {
  std::vector<std::vector<std::string>> parts;
  for (const std::string& place : places) parts.push_back(parts_of(place));
  const auto all_share = [&](const auto& end_of) {
    return std::ranges::all_of(parts,
                               [&](const auto& one) { return one.size() > 1 && end_of(one) == end_of(parts[0]); });
  };
  while (all_share([](const auto& one) { return one.back(); }))
    for (auto& one : parts) one.pop_back();
  while (all_share([](const auto& one) { return one.front(); }))
    for (auto& one : parts) one.erase(one.begin());
  std::vector<std::string> names;
  for (auto& one : parts) {
    if (one.size() > 1 && one.back() == "results") one.pop_back();  // where others have other names
    fs::path name;
    for (const std::string& part : one) name /= part;
    names.push_back(name.string());
  }
  drop_common_values(names);
  return names;
}

std::vector<ComparedRun> open_compared(const std::vector<std::string>& places, const Session& session) {
  if (places.size() > most_compared)
    throw InputError(
        fmt::format("report: {} runs are too many for one page (at most {}); a sweep has a page of its own",
                    places.size(), most_compared));
  const std::vector<std::string> names = short_names(places);
  std::vector<ComparedRun> runs;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ComparedRun run = open_run(places[i], session);
    run.name = names[i];
    for (std::size_t k = 0; k < i; ++k)
      if (fs::equivalent(runs[k].results, run.results))
        throw InputError(fmt::format("report: {} and {} are the same run", places[k], places[i]));
    runs.push_back(std::move(run));
  }
  return runs;
}

Table differing_keys(const std::vector<ComparedRun>& runs, std::size_t limit) {
  std::vector<std::map<std::string, std::string>> values;
  std::map<std::string, std::vector<std::string>> rows;
  for (const ComparedRun& run : runs) values.push_back(values_of(run.file));
  for (const auto& of_run : values)
    for (const auto& [path, ignored] : of_run) rows[path];
  for (auto& [path, row] : rows)
    for (const auto& of_run : values) row.push_back(of_run.contains(path) ? of_run.at(path) : "\u2013");
  std::erase_if(rows, [](const auto& row) {
    return std::ranges::count(row.second, row.second[0]) == static_cast<std::ptrdiff_t>(row.second.size());
  });
  Table table{.caption = "Keys that differ", .rows = {{"key"}}, .has_header = true};
  for (const ComparedRun& run : runs) table.rows[0].push_back(run.name);
  for (auto& [path, row] : rows) {
    if (table.rows.size() > limit) break;
    table.rows.push_back({path});
    for (std::string& value : row) table.rows.back().push_back(std::move(value));
  }
  if (rows.size() > limit) {
    table.rows.push_back({fmt::format("and {} more", rows.size() - limit)});
    table.rows.back().resize(table.rows[0].size());
  }
  return table;
}

}  // namespace pfdm
