#include "cases/program/fracture/outcome/mean_curve.h"

#include "physics/elasticity/mandel.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

std::string strain_column(std::string_view component) { return fmt::format("strain_{}", component); }
std::string stress_column(std::string_view component) { return fmt::format("stress_{}_Pa", component); }

std::vector<double> column_of(const StepTable& table, const std::string& name) {
  const auto k = static_cast<std::size_t>(std::ranges::find(table.names(), name) - table.names().begin());
  std::vector<double> values;
  for (const std::vector<double>& row : table.rows()) values.push_back(row[k]);
  return values;
}

}  // namespace

std::string_view name_of_component(const std::array<int, 2>& component) {
  return component_names[std::ranges::find(component_places, component) - component_places.begin()];
}

std::vector<std::string> columns_of_means(const std::vector<InterfaceSettings>& interfaces) {
  std::vector<std::string> names{"step", "load"};
  for (const std::string_view component : component_names) names.push_back(strain_column(component));
  for (const std::string_view component : component_names) names.push_back(stress_column(component));
  for (const InterfaceSettings& interface : interfaces)
    names.push_back(fmt::format("debonded_area_{}_m2", interface.name));
  for (const EnergyEntry& entry : energy_entries) names.push_back(fmt::format("{}_J", entry.column));
  return names;
}

std::vector<double> row_of_means(const StepReport& report) {
  std::vector<double> row{static_cast<double>(report.step), report.load};
  for (const auto& [i, j] : component_places) row.push_back(report.means->strain(i, j));
  for (const auto& [i, j] : component_places) row.push_back(report.means->stress(i, j));
  row.insert(row.end(), report.debonded_area.begin(), report.debonded_area.end());
  for (const EnergyEntry& entry : energy_entries) row.push_back(report.energy.*entry.value);
  return row;
}

CurveRow curve_row_of_box(const StepReport& report, const Vector& size, const std::array<int, 2>& component) {
  const auto [i, j] = component;
  CurveRow row = curve_row(report);
  row.displacement = (i == j ? 1.0 : 2.0) * report.means->strain(i, j) * size[j];
  row.force = report.means->stress.col(j) * (size.prod() / size[j]);
  return row;
}

std::map<std::string, double> figures_of_means(const StepTable& table, const std::array<int, 2>& component) {
  const std::string_view name = name_of_component(component);
  const std::vector<double> strain = column_of(table, strain_column(name)),
                            stress = column_of(table, stress_column(name));
  if (stress.empty()) return {};
  const auto peak = static_cast<std::size_t>(
      std::ranges::max_element(stress, {}, [](double value) { return std::abs(value); }) - stress.begin());
  std::map<std::string, double> figures{{fmt::format("peak_stress_{}_Pa", name), stress[peak]},
                                        {fmt::format("strain_{}_at_peak", name), strain[peak]},
                                        {fmt::format("final_stress_{}_Pa", name), stress.back()},
                                        {fmt::format("final_strain_{}", name), strain.back()}};
  if (strain.size() > 1 && strain[1] != 0.0)
    figures[fmt::format("initial_modulus_{}_Pa", name)] = stress[1] / strain[1];
  return figures;
}

void name_as_means(std::map<std::string, double>& figures, const Vector& size, const std::array<int, 2>& component) {
  const auto [i, j] = component;
  const std::string name(name_of_component(component));
  std::map<std::string, double> means;
  for (const auto& [key, value] : figures) {
    const auto renamed = [&key](std::string_view what, const std::string& by, std::string_view unit) {
      std::string result = key;
      return result.replace(key.find(what), what.size(), by).replace(result.rfind(unit), unit.size(), "");
    };
    if (key.find("displacement") != std::string::npos)
      means[renamed("displacement", "strain_" + name, "_m")] = value / ((i == j ? 1.0 : 2.0) * size[j]);
    else if (key.find("force") != std::string::npos)
      means[renamed("force", "stress_" + name, "_N") + "_Pa"] = value * size[j] / size.prod();
    else
      means[key] = value;
  }
  figures = std::move(means);
}

MeanCurve read_mean_curve(const std::filesystem::path& results, const std::vector<InterfaceSettings>& interfaces,
                          const std::array<int, 2>& component) {
  const CsvTable table =
      read_csv(results / means_file, {.own_names = columns_of_means(interfaces), .n_newer_names = n_newer_energies});
  const std::string_view name = name_of_component(component);
  return {table.column(strain_column(name)), table.column(stress_column(name))};
}

}  // namespace pfdm
