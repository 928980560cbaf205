#include "cases/program/studies/sweep/shown_columns.h"

#include "cases/program/session/report_parts.h"
#include "postproc/files/text_file.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// Endings of columns' names, and the units that they stand for; the longest first.
struct Ending {
  std::string_view ending, unit;
  bool takes_prefix;
};
constexpr Ending endings[] = {{"_N_per_m", "N/m", true},
                              {"_J_per_m2", "J/m²", false},
                              {"_J_per_m3", "J/m^3", true},
                              {"_bytes", "B", true},
                              {"_m2", "m^2", true},
                              {"_m3", "m^3", true},
                              {"_Pa", "Pa", true},
                              {"_Hz", "Hz", true},
                              {"_deg", "°", false},
                              {"_N", "N", true},
                              {"_J", "J", true},
                              {"_m", "m", true},
                              {"_s", "s", true},
                              {"_K", "K", false},
                              {"_kg", "kg", false}};

constexpr std::string_view costs[] = {"threads",      "staggered_iterations", "krylov_iterations",
                                      "wall_seconds", "cpu_seconds",          "peak_memory_bytes"};

/// Of a box, whose force and displacement nobody asks for, mean stress and strain in their place.
std::vector<std::string> headline_names(const CsvTable& table) {
  constexpr std::string_view peak = "peak_stress_", in_pascals = "_Pa";
  const auto of_box = std::ranges::find_if(
      table.names, [&](const std::string& name) { return name.starts_with(peak) && name.ends_with(in_pascals); });
  std::vector<std::string> names{"peak_force_N", "displacement_at_peak_m", "first_debonding_force_N",
                                 "first_debonding_displacement_m", "initial_stiffness_N_per_m"};
  if (of_box != table.names.end()) {
    const std::string along = of_box->substr(peak.size(), of_box->size() - peak.size() - in_pascals.size());
    names = {*of_box, fmt::format("strain_{}_at_peak", along), fmt::format("first_debonding_stress_{}_Pa", along),
             fmt::format("first_debonding_strain_{}", along), fmt::format("initial_modulus_{}_Pa", along)};
  }
  names.emplace_back("cohesive_strength_Pa");
  names.emplace_back("cohesive_energy_J_per_m2");
  return names;
}

}  // namespace

std::string ShownColumn::title() const {
  if (names.empty()) return fmt::format("{} [{}]", words, unit.empty() ? "-" : unit);
  constexpr std::size_t longest = 60;  // that an axis has room for
  std::vector<std::string> meanings;
  for (std::size_t k = 0; k < names.size(); ++k) meanings.push_back(fmt::format("{} {}", k, names[k]));
  const std::string all = fmt::format("{} ({})", words, fmt::join(meanings, ", "));
  return all.size() <= longest ? all : fmt::format("{} (values 0, 1, ... of the list)", words);
}

std::string ShownColumn::cell(std::size_t i) const {
  return names.empty() ? shown(values[i]) : names.at(static_cast<std::size_t>(values[i]));
}

std::string in_ascii(std::string unit) {
  for (const auto& [sign, plain] :
       {std::pair("µ", "u"), std::pair("²", "^2"), std::pair("³", "^3"), std::pair("°", "deg")})
    if (const std::size_t at = unit.find(sign); at != std::string::npos)
      unit.replace(at, std::string_view(sign).size(), plain);
  return unit;
}

std::vector<std::size_t> headline_columns(const CsvTable& table) {
  std::vector<std::size_t> columns;
  for (const std::string& name : headline_names(table))
    if (const auto found = std::ranges::find(table.names, name); found != table.names.end())
      columns.push_back(static_cast<std::size_t>(found - table.names.begin()));
  return columns;
}

std::string comment_of_word(const std::string& column, std::size_t k, const std::string& word) {
  return fmt::format("{}, {}:{}{}", column, k, trimmed(word).empty() ? "" : " ", trimmed(word));
}

ShownColumn shown_column(const CsvTable& table, std::size_t j) {
  ShownColumn column = shown_column(table.names[j], table.columns[j]);
  for (const std::string& comment : table.comments) {
    const std::string mark = comment_of_word(table.names[j], column.names.size(), "");
    if (const std::string_view told = trimmed(comment); told.starts_with(mark))
      column.names.emplace_back(trimmed(told.substr(mark.size())));
  }
  return column;
}

ShownColumn shown_column(const std::string& name, const std::vector<double>& values) {
  const auto ending = std::ranges::find_if(endings, [&](const Ending& e) { return name.ends_with(e.ending); });
  ShownColumn column{.words = name, .unit = {}, .values = values};
  if (ending != std::end(endings)) {
    column.words = name.substr(0, name.size() - ending->ending.size());
    DisplayUnit unit{.factor = 1.0, .name = std::string(ending->unit)};
    if (ending->takes_prefix) unit = common_unit(std::span(&values, 1), ending->unit);
    column.unit = unit.name;
    column.values = in_unit(values, unit);
  }
  std::ranges::replace(column.words, '_', ' ');
  return column;
}

bool varies(const std::vector<double>& values) {
  double least = INFINITY, most = -INFINITY;
  for (const double value : values)
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  return most - least > 1e-9 * std::max(std::abs(least), std::abs(most));
}

bool is_cost(std::string_view name) { return std::ranges::count(costs, name) > 0; }

}  // namespace pfdm
