#include "cases/program/studies/sweep/sweep.h"

#include "cases/program/input/config/result_number.h"
#include "cases/program/session/head_line.h"
#include "cases/program/session/runnable_case.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/studies/runs/case_runs.h"
#include "cases/program/studies/sweep/shown_columns.h"
#include "cases/program/studies/sweep/sweep_changes.h"
#include "cases/program/studies/sweep/sweep_on_slurm.h"
#include "cases/program/studies/sweep/sweep_report.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// "regions.interface.toughness_J_per_m2"
std::string column_name(const CaseParameter& parameter) {
  return parameter.unit.empty() ? parameter.name : parameter.name + "_" + in_names(parameter.dimension.si_unit);
}

std::vector<std::optional<ReadSummary>> summaries_of(const std::vector<DoneRun>& runs) {
  std::vector<std::optional<ReadSummary>> summaries;
  summaries.reserve(runs.size());
  for (const DoneRun& run : runs)
    summaries.push_back(run.went_well() ? read_summary(run.folder / summary_file) : std::nullopt);
  return summaries;
}

/// Names of the figures that any run has, but for those of its cost.
std::vector<std::string> figures_of(const std::vector<std::optional<ReadSummary>>& summaries) {
  std::vector<std::string> names;
  for (const auto& summary : summaries) {
    if (!summary) continue;
    for (const auto& [name, ignored] : summary->numbers)
      if (!is_cost(name) && std::ranges::count(names, name) == 0) names.push_back(name);
  }
  return names;
}

/// Whether the runs differ by seeds alone: realisations of one case.
bool are_realisations(const SweepSettings& settings) {
  const auto is_seed = [](const std::string& key) {
    return key == "seed" || key.ends_with(".seed") || key.ends_with("_seed");
  };
  return !settings.is_of_changes && std::ranges::all_of(settings.parameters, [&](const CaseParameter& p) {
    return std::ranges::all_of(p.keys, is_seed);
  });
}

/// In ASCII, as all that a terminal gets. `shown`: of mean and standard deviation.
std::string scatter_line(const ShownColumn& shown, std::size_t n) {
  const std::string unit = shown.unit.empty() ? "" : " " + in_ascii(shown.unit);
  return fmt::format("{}: mean {:.6g}{}, standard deviation {:.3g}{}, of {} realisations", shown.words, shown.values[0],
                     unit, shown.values[1], unit, n);
}

/// Of the figures of the realisations that converged, if there are two or more; deviations are those of a sample.
std::vector<std::string> scatter(const SweepSettings& settings, const CsvTable& table) {
  std::vector<std::string> lines;
  const std::vector<double>& converged = table.column("converged");
  if (!are_realisations(settings)) return lines;
  constexpr double rounding = 1e-12;
  for (std::size_t j = table.find("converged") + 1; j < table.names.size(); ++j) {
    std::vector<double> values;
    for (std::size_t i = 0; i < converged.size(); ++i)
      if (converged[i] > 0.0) values.push_back(table.columns[j][i]);
    if (values.size() < 2) return lines;
    const double n = static_cast<double>(values.size()), mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double deviation = std::sqrt(squares / (n - 1.0));
    if (deviation > rounding * std::abs(mean))
      lines.push_back(scatter_line(shown_column(table.names[j], {mean, deviation}), values.size()));
  }
  return lines;
}

/// "sylgard.young_modulus=75MPa,interface.toughness=400J_m2", of a change "half_the_steps"; "run_3" of run 3 where that
/// would be too long.
std::string name_by_value(const SweepSettings& settings, std::size_t run) {
  constexpr std::size_t longest = 100;
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.=,+-_";
  std::string name;
  for (std::size_t j = 0; j < settings.parameters.size(); ++j) {
    const CaseParameter& parameter = settings.parameters[j];
    const std::string value = parameter.shown(settings.points[run][j]);
    std::string part = settings.is_of_changes ? value : fmt::format("{}={}", parameter.short_name(), value);
    if (settings.is_of_changes) std::ranges::replace(part, ' ', '_');
    std::erase_if(part, [](char c) { return c == ' ' || c == '^' || c == ']'; });
    for (char& c : part)
      if (plain.find(c) == std::string_view::npos) c = '_';
    name += (name.empty() ? "" : ",") + part;
  }
  return name.size() <= longest ? name : fmt::format("run_{}", run + 1);
}

/// Of every run name_by_value(), or "run_3" of run 3 where that is the name of an earlier run with other values.
std::vector<std::string> names_by_value(const SweepSettings& settings) {
  std::map<std::string, std::size_t> first;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < settings.points.size(); ++i) {
    std::string name = name_by_value(settings, i);
    const std::size_t earlier = first.try_emplace(name, i).first->second;
    const bool same =
        shown(settings.parameters, settings.points[i]) == shown(settings.parameters, settings.points[earlier]);
    names.push_back(same ? std::move(name) : fmt::format("run_{}", i + 1));
  }
  return names;
}

constexpr const char* links_folder = "runs_by_value";

/// Links to the runs' folders, by value; where the disk has no links there are none.
void link_by_value(const SweepSettings& settings, const std::vector<DoneRun>& runs, const fs::path& results) {
  std::error_code ignored;
  fs::create_directory(results / links_folder, ignored);
  const std::vector<std::string> names = names_by_value(settings);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].folder.empty()) continue;
    const fs::path link = results / links_folder / names[i];
    if (fs::is_symlink(link, ignored)) fs::remove(link, ignored);
    fs::create_directory_symlink(fs::path("..") / fs::relative(runs[i].folder, results), link, ignored);
  }
}

/// Where the run is, and by which name of its values too.
std::string place_of(const DoneRun& run, const std::string& name, const fs::path& results) {
  const std::string folder = fs::relative(run.folder, results).string();
  const bool linked = fs::is_symlink(results / links_folder / name);
  return linked ? fmt::format("{}, {}/{}", folder, links_folder, name) : folder;
}

CsvTable table_of(const SweepSettings& settings, const std::vector<DoneRun>& runs, const fs::path& results) {
  CsvTable table;
  const auto summaries = summaries_of(runs);
  const std::vector<std::string> names = names_by_value(settings);
  std::vector<double> number, converged;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    number.push_back(static_cast<double>(i + 1));
    converged.push_back(runs[i].went_well() ? 1.0 : 0.0);
    table.comments.push_back(runs[i].went_well()
                                 ? fmt::format("run {}: {}", i + 1, place_of(runs[i], names[i], results))
                                 : fmt::format("run {}: {}", i + 1, runs[i].failure));
  }
  table.add("run", number);
  for (const CaseParameter& parameter : settings.parameters)
    for (std::size_t k = 0; k < parameter.words.size(); ++k)
      table.comments.push_back(comment_of_word(parameter.name, k, parameter.words[k]));
  for (std::size_t j = 0; j < settings.parameters.size(); ++j) {
    std::vector<double> values;
    for (const std::vector<double>& point : settings.points) values.push_back(point[j]);
    table.add(column_name(settings.parameters[j]), std::move(values));
  }
  table.add("converged", converged);
  for (const std::string& name : figures_of(summaries)) {
    std::vector<double> values;
    values.reserve(summaries.size());
    for (const auto& summary : summaries) values.push_back(summary ? summary->number(name) : Headlines::none);
    table.add(name, std::move(values));
  }
  return table;
}

}  // namespace

void run_sweep(const CaseFile& file, const SweepSettings& settings, Session& session) {
  const Stopwatch watch;
  if (session.slurm) require_slurm();
  const FolderLock lock(session.results);
  session.log.say(
      head_line(session, fmt::format("sweep of {}: {}", case_name(file), counted(count_of(settings.points), "run"))));
  session.log.open_file(session.results / "sweep.log", true);
  CaseRuns runs(session.results / "runs", session);
  if (settings.is_of_changes) runs.record_laws();
  const std::vector<CaseVariant> variants = variants_of(settings, file);
  const std::vector<MissingRun> missing = runs.missing(variants);
  if (!missing.empty() && session.slurm) return hand_to_slurm(file, settings.slurm, missing, session);
  if (!missing.empty()) require_no_tasks_of(session);
  const std::vector<DoneRun> done = runs.run(variants);
  link_by_value(settings, done, session.results);
  CsvTable table = table_of(settings, done, session.results);
  for (const std::string& line : scatter(settings, table)) {
    table.comments.push_back(line);
    session.log.say(fmt::format("  {}", line));
  }
  for (const std::string& line : lines_of_changes(settings, table)) {
    table.comments.push_back(fmt::format("{}{}", mark_of_changes, line));
    session.log.say(fmt::format("  {}", line));
  }
  write_csv(session.results / "sweep.csv", table);
  if (std::ranges::none_of(done, &DoneRun::went_well))
    throw ComputationError(fmt::format("none of the {} runs of the sweep came to its end; run 1: {}; all are in {}",
                                       done.size(), done.front().failure, (session.results / sweep_file).string()));
  session.log.say(fmt::format("{} runs made, {} reused, {} of them did not converge; {:.1f} s; written to {}",
                              runs.n_made(), runs.n_reused(), runs.n_failed(), watch.seconds(),
                              (session.results / sweep_file).string()));
}

void say_sweep(const CaseFile& file, const SweepSettings& settings, Session& session) {
  constexpr std::size_t most = 12, most_read = 1000;
  const std::vector<CaseVariant> variants = variants_of(settings, file);
  const std::size_t n = variants.size();
  session.log.say(fmt::format("pfdm sweep would make {}:", counted(static_cast<Index>(n), "run")));
  for (std::size_t i = 0; i < n; ++i) {
    const CaseVariant& variant = variants[i];
    if (i < most) session.log.say(fmt::format("  run {}: {}", i + 1, variant.shown));
    if (i >= most_read) break;
    try {
      session.read_case(variant.file);
    } catch (const InputError& error) {
      session.log.warn(
          fmt::format("run {} of the sweep cannot be made, with {}: {}", i + 1, variant.shown, error.what()));
    }
  }
  if (n > most) session.log.say(fmt::format("  and {} more", n - most));
}

}  // namespace pfdm
