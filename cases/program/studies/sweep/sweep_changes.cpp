#include "cases/program/studies/sweep/sweep_changes.h"

#include "cases/program/studies/runs/finer_case.h"
#include "cases/program/studies/sweep/shown_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

}  // namespace

SweepSettings read_changes(const ConfigTable& sweep, const CaseFile& file) {
  if (!sweep.has("changes"))
    throw sweep.error(
        "the method \"changes\" needs [sweep.changes], as in \"finer mesh\" = { \"mesh.x[0].cells\" = 80 }");
  if (sweep.has("parameters")) throw sweep.at("parameters").error("the method \"changes\" takes [sweep.changes] alone");
  const ConfigTable changes = sweep.table("changes");
  SweepSettings settings;
  if (sweep.has("slurm")) settings.slurm = read_slurm(sweep.table("slurm"));
  CaseParameter change{.name = "change", .keys = {}, .ratios = {}, .unit = {}, .words = {"none"}};
  settings.variants.push_back({file, "the case as it is"});
  for (const auto& [name, keys] : changes.entries()) {
    settings.variants.push_back(*changed_case(changes, name, file));
    change.words.push_back(name);
  }
  if (change.words.size() == 1) throw sweep.at("changes").error("at least one change is required");
  settings.parameters.push_back(std::move(change));
  for (std::size_t k = 0; k < settings.variants.size(); ++k) settings.points.push_back({static_cast<double>(k)});
  return settings;
}

std::vector<std::string> lines_of_changes(const SweepSettings& settings, const CsvTable& table) {
  std::vector<std::string> lines;
  if (settings.variants.empty() || table.column("converged").front() == 0.0) return lines;
  const std::vector<std::string>& words = settings.parameters.front().words;
  for (const std::size_t j : headline_columns(table)) {
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
