#include "cases/program/studies/sweep/sweep_changes.h"

#include "cases/program/studies/runs/finer_case.h"
#include "cases/program/studies/sweep/shown_columns.h"
#include "cases/program/studies/sweep/sweep_report.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// In per cent; nothing where one of them is not known, or the first is zero.
std::string change_text(double from, double to) {
  if (!std::isfinite(from) || !std::isfinite(to) || from == 0.0) return "not known";
  const double percent = 100.0 * (to / from - 1.0);
  if (std::abs(percent) < 5e-3) return "0 %";
  return std::abs(percent) < 99.5 ? fmt::format("{:+.2g} %", percent) : fmt::format("{:+.0f} %", percent);
}

/// Of the figures that one asks for first; of a kind of case that has none of them those that differ, but for
/// sizes.
std::vector<std::size_t> told_columns(const CsvTable& table) {
  constexpr std::size_t most = 12;
  constexpr std::string_view sizes[] = {"cells", "unknowns", "steps"};
  std::vector<std::size_t> columns = headline_columns(table);
  if (!columns.empty()) return columns;
  for (std::size_t j = table.find("converged") + 1; j < table.names.size() && columns.size() < most; ++j)
    if (varies(table.columns[j]) && std::ranges::count(sizes, table.names[j]) == 0) columns.push_back(j);
  return columns;
}

}  // namespace

SweepSettings read_changes(const ConfigTable& sweep) {
  if (!sweep.has("changes"))
    throw sweep.error(
        "the method \"changes\" needs [sweep.changes], as in \"finer mesh\" = { \"mesh.x[0].cells\" = 80 }");
  if (sweep.has("parameters")) throw sweep.at("parameters").error("the method \"changes\" takes [sweep.changes] alone");
  const ConfigTable changes = sweep.table("changes");
  SweepSettings settings;
  if (sweep.has("slurm")) settings.slurm = read_slurm(sweep.table("slurm"));
  CaseParameter change{.name = change_column, .keys = {}, .ratios = {}, .unit = {}, .words = {"as it is"}};
  for (const auto& [name, keys] : changes.entries()) change.words.push_back(name);
  if (change.words.size() == 1) throw sweep.at("changes").error("at least one change is required");
  for (std::size_t k = 0; k < change.words.size(); ++k) settings.points.push_back({static_cast<double>(k)});
  settings.parameters.push_back(std::move(change));
  settings.is_of_changes = true;
  return settings;
}

std::vector<CaseVariant> changed_cases(const CaseFile& file) {
  const ConfigTable changes = file.config.root().table("sweep").table("changes");
  std::vector<CaseVariant> variants{{file, "the case as it is"}};
  for (const auto& [name, keys] : changes.entries()) {
    CaseVariant variant = *changed_case(changes, name, file);
    variant.shown = fmt::format("{} ({})", name, variant.shown);
    variants.push_back(std::move(variant));
  }
  return variants;
}

std::optional<std::string> told_change(std::string_view comment) {
  const std::string_view told = trimmed(comment);
  if (!told.starts_with(mark_of_changes)) return std::nullopt;
  return std::string(told.substr(mark_of_changes.size()));
}

std::vector<std::string> told_changes(const CsvTable& table) {
  std::vector<std::string> lines;
  for (const std::string& comment : table.comments)
    if (auto told = told_change(comment)) lines.push_back(std::move(*told));
  return lines;
}

std::string most_of_changes(const CsvTable& table) {
  if (told_changes(table).empty()) return "";
  const ShownColumn changes = shown_column(table, table.find(change_column));
  std::vector<std::string> told;
  for (const std::size_t j : told_columns(table)) {
    const std::vector<double>& values = table.columns[j];
    const auto change = [&](std::size_t k) { return std::abs(values[k] / values.front() - 1.0); };
    std::size_t most = 0;
    for (std::size_t k = 1; k < values.size(); ++k)
      if (std::isfinite(change(k)) && (most == 0 || change(k) > change(most))) most = k;
    if (most > 0)
      told.push_back(fmt::format("{} {} ({})", shown_column(table, j).words, change_text(values.front(), values[most]),
                                 changes.cell(most)));
  }
  return fmt::format("What one of its changes does at most: {}.", fmt::join(told, ", "));
}

std::string words_of_error(const std::filesystem::path& results, double peak_force) {
  constexpr double rounding = 1e-9;
  if (std::filesystem::exists(results / sweep_file)) {
    const CsvTable table = read_csv(results / sweep_file, {.has_gaps = true});
    const std::vector<std::string> lines = told_changes(table);
    const auto peak = std::ranges::find(table.names, "peak_force_N") - table.names.begin();
    const bool is_of_run = peak < std::ssize(table.names) && table.n_rows() > 0 &&
                           std::abs(table.columns[peak].front() - peak_force) <= rounding * std::abs(peak_force);
    if (!lines.empty() && is_of_run)
      return fmt::format("What the changes of its sweep do to it, one at a time: {}.", fmt::join(lines, "; "));
  }
  return "One run does not tell what its mesh and steps do to it: pfdm sweep with the method \"changes\" does.";
}

std::vector<std::string> lines_of_changes(const SweepSettings& settings, const CsvTable& table) {
  std::vector<std::string> lines;
  if (!settings.is_of_changes || table.column("converged").front() == 0.0) return lines;
  const std::vector<std::string>& words = settings.parameters.front().words;
  for (const std::size_t j : told_columns(table)) {
    const ShownColumn figure = shown_column(table, j);
    if (!std::isfinite(figure.values.front())) continue;
    std::vector<std::string> told;
    for (std::size_t k = 1; k < words.size(); ++k)
      told.push_back(fmt::format("{} {}", words[k], change_text(figure.values.front(), figure.values[k])));
    const std::string unit = in_ascii(figure.unit);
    lines.push_back(fmt::format("{} {:.4g}{}{}: {}", figure.words, figure.values.front(), unit.empty() ? "" : " ", unit,
                                fmt::join(told, ", ")));
  }
  return lines;
}

}  // namespace pfdm
