#include "cases/program/fracture/experiment_case.h"

#include "cases/program/point/control_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

constexpr const char* positive_pole = "positive";

SampledCurve read_curve_of(const ConfigTable& table, const std::filesystem::path& directory, const char* quantity,
                           const Dimension& due) {
  const CsvTable file = read_csv_of(table, directory);
  const auto column = [&](const char* key, const Dimension& dimension) {
    return read_column(table.table(key).with_keys({"column", "unit"}), file, "column", "unit", dimension);
  };
  SampledCurve curve{
      .name = table.string("name"), .x = column("displacement", dimension::length), .y = column(quantity, due)};
  if (table.has("deviation")) {
    curve.deviation = column("deviation", due);
    if (std::ranges::any_of(curve.deviation, [](double d) { return d < 0.0; }))
      throw table.at("deviation").error("a standard deviation must not be negative");
  }
  if (!std::ranges::is_sorted(curve.x))
    throw table.at("displacement").error("the displacements decrease: remove unloading, and sort the rows");
  return curve;
}

MeasuredAngle read_angle(const ConfigTable& table, const std::filesystem::path& directory) {
  table.with_keys({"name", "csv", "displacement", "angle", "deviation", "surface", "pole"});
  const std::string poles[] = {positive_pole, "negative"};
  return {.curve = read_curve_of(table, directory, "angle", dimension::angle),
          .surface = table.string("surface", ""),
          .at_positive = table.at("pole").one_of(poles, "pole") == positive_pole};
}

}  // namespace

std::optional<ExperimentSettings> read_experiment(const ConfigTable& root,
                                                  const std::filesystem::path& case_directory) {
  if (!root.has("experiment")) return std::nullopt;
  const ConfigTable table = root.table("experiment").with_keys({"stiffness_between", "specimens", "debonding"});
  ExperimentSettings settings{.where = table};
  const ConfigValue range = table.at("stiffness_between");
  const std::vector<ConfigValue> ends = range.list(2);
  settings.stiffness_from = ends[0].quantity(dimension::length);
  settings.stiffness_to = ends[1].quantity(dimension::length);
  if (!(settings.stiffness_from < settings.stiffness_to))
    throw range.error("the second displacement must be the larger");
  for (const ConfigTable& specimen : table.tables("specimens"))
    settings.specimens.push_back(
        read_curve_of(specimen.with_keys({"name", "csv", "displacement", "force", "deviation"}), case_directory,
                      "force", dimension::force));
  if (settings.specimens.empty())
    throw table.error("no measured curve is named; at least one [[experiment.specimens]] is required");
  for (const ConfigTable& debonding : table.tables("debonding")) {
    settings.angles.push_back(read_angle(debonding, case_directory));
    const MeasuredAngle &first = settings.angles.front(), &last = settings.angles.back();
    if (first.surface != last.surface || first.at_positive != last.at_positive)
      throw debonding.error("all angles must be those of one pole of one surface");
  }
  return settings;
}

}  // namespace pfdm
