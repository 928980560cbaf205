#include "cases/program/fracture/case/experiment_case.h"

#include "cases/program/fracture/case/event_case.h"
#include "cases/program/fracture/case/run_keys.h"
#include "cases/program/input/fields/csv_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

namespace pfdm {
namespace {

/// Tables that may have a key: the specimen's, and where it does not have it that of all.
class Defaults {
 public:
  Defaults(const ConfigTable& own, const ConfigTable& of_all) : own_(own), of_all_(of_all) {}
  std::optional<ConfigValue> find(std::string_view key) const {
    return own_.has(key) ? own_.find(key) : of_all_.find(key);
  }
  double quantity(std::string_view key) const {
    const auto value = find(key);
    return value ? value->quantity() : 0.0;
  }

 private:
  const ConfigTable& own_;
  const ConfigTable& of_all_;
};

Toe read_toe(const ConfigValue& value) {
  const std::vector<ConfigValue> ends = value.list(2);
  const std::string first = ends[0].string();
  const bool of_length = ends[0].in_context([&] { return is_unit_of(unit_of(first), dimension::length); });
  const Dimension& due = of_length ? dimension::length : dimension::force;
  const Toe toe{.from = ends[0].quantity(due), .to = ends[1].quantity(due), .of_force = !of_length};
  if (!(toe.from < toe.to)) throw value.error("the second end of the straight part must be the larger");
  return toe;
}

Preparation read_preparation(const Defaults& keys) {
  Preparation preparation{.jitter = keys.quantity("jitter")};
  if (const auto loops = keys.find("loops")) preparation.envelope = loops->choice() == "envelope";
  if (const auto toe = keys.find("toe")) preparation.toe = read_toe(*toe);
  return preparation;
}

SetUp read_set_up(const Defaults& keys) {
  return {.offset = keys.quantity("offset"),
          .force_offset = keys.quantity("force_offset"),
          .compliance = keys.quantity("compliance")};
}

std::string read_name_of_curve(const ConfigTable& table) {
  const ConfigValue name = table.at("name");
  if (name.line().empty()) throw name.error("the name is empty");
  return name.line();
}

double factor_of(const ConfigTable& column) { return column.number("factor", 1.0); }

/// { column, unit, factor }: times the factor, and without one times `otherwise`.
std::vector<double> read_values(const ConfigTable& table, const CsvTable& file, const Dimension& due,
                                double otherwise = 1.0) {
  const double factor = table.number("factor", otherwise);
  if (factor == 0.0) throw table.at("factor").error("it must not be zero");
  std::vector<double> values = read_column(table, file, "column", "unit", due);
  for (double& value : values) value *= factor;
  return values;
}

SampledCurve read_curve_of(const ConfigTable& table, const std::filesystem::path& directory, const char* quantity,
                           const Dimension& due) {
  const CsvTable file = read_csv_of(table, directory);
  SampledCurve curve{.name = read_name_of_curve(table),
                     .x = read_values(table.table("displacement"), file, dimension::length),
                     .y = read_values(table.table(quantity), file, due)};
  std::vector<std::vector<double>*> used{&curve.x, &curve.y};
  if (table.has("deviation")) {
    curve.deviation = read_values(table.table("deviation"), file, due, std::abs(factor_of(table.table(quantity))));
    used.push_back(&curve.deviation);
  }
  leave_out_gaps(table, used);
  if (std::ranges::any_of(curve.deviation, [](double d) { return d < 0.0; }))
    throw table.at("deviation").error("a standard deviation must not be negative");
  return curve;
}

/// Displacement, force and crack length, where it is not NaN.
SampledCurve read_crack_lengths(const ConfigTable& table, const std::filesystem::path& directory) {
  constexpr double none = -1.0;  // keeps a row whose crack was not read
  const CsvTable file = read_csv_of(table, directory);
  SampledCurve curve{.name = read_name_of_curve(table),
                     .x = read_values(table.table("displacement"), file, dimension::length),
                     .y = read_values(table.table("force"), file, dimension::force)};
  if (table.has("crack_length")) curve.deviation = read_values(table.table("crack_length"), file, dimension::length);
  for (double& length : curve.deviation)
    if (std::isnan(length)) length = none;
  std::vector<std::vector<double>*> used{&curve.x, &curve.y};
  if (!curve.deviation.empty()) used.push_back(&curve.deviation);
  leave_out_gaps(table, used);
  for (double& length : curve.deviation)
    if (!(length > 0.0)) length = std::nan("");
  return curve;
}

MeasuredCurve prepared_curve(const ConfigTable& table, const ConfigTable& of_all, const SampledCurve& recorded) {
  const Defaults keys(table, of_all);
  if (std::ranges::all_of(recorded.y, [](double force) { return force == 0.0; }))
    throw table.at("force").error("all forces are zero; there is nothing to compare with");
  const Preparation preparation = read_preparation(keys);
  const SetUp set_up = read_set_up(keys);
  MeasuredCurve specimen = table.at("displacement").in_context([&] { return prepared(recorded, preparation, set_up); });
  specimen.displacement_factor = factor_of(table.table("displacement"));
  specimen.force_factor = factor_of(table.table("force"));
  return specimen;
}

MeasuredCurve read_specimen(const ConfigTable& table, const ConfigTable& of_all,
                            const std::filesystem::path& directory) {
  return prepared_curve(table, of_all, read_curve_of(table, directory, "force", dimension::force));
}

MeasuredAngle read_angle(const ConfigTable& table, const std::filesystem::path& directory) {
  const SampledCurve curve = read_curve_of(table, directory, "angle", dimension::angle);
  if (!std::ranges::is_sorted(curve.x))
    throw table.at("displacement").error("the displacements decrease: remove unloading, and sort the rows");
  return {.curve = curve, .surface = table.string("surface", ""), .at_positive = table.choice("pole") == "positive"};
}

MeasuredEnergy read_energy(const ConfigTable& table, const std::filesystem::path& directory) {
  return {.curve = read_curve_of(table, directory, "energy", dimension::energy),
          .kind = &choose(table.at("of"), energy_kinds(), "energy of a run")};
}

double stored_energy(const EnergyAccount&, const EnergyAccount& now) {
  double sum = 0.0;
  for (const EnergyEntry& entry : energy_entries)
    if (entry.role == EnergyEntry::Role::stored) sum += now.*entry.value;
  return sum;
}

constexpr EnergyKind kinds_of_energy[] = {
    {"work", "work of the load", [](const EnergyAccount&, const EnergyAccount& now) { return now.external_work; }},
    {"stored", "elastic energy, that of interfaces included", stored_energy},
    {"dissipated", "surface energy gained and all that was dissipated",
     [](const EnergyAccount& start, const EnergyAccount& now) {
       return now.fracture - start.fracture + dissipated(now);
     }},
};

}  // namespace

std::span<const EnergyKind> energy_kinds() { return kinds_of_energy; }

std::vector<SampledCurve> specimen_curves(const ExperimentSettings& experiment) {
  std::vector<SampledCurve> curves;
  for (const MeasuredCurve& specimen : experiment.specimens) curves.push_back(specimen.of_specimen());
  return curves;
}

MeasuredCurve read_fracture_test(const ConfigTable& specimen, const ConfigTable& experiment,
                                 const std::filesystem::path& case_directory) {
  return prepared_curve(specimen, experiment, read_crack_lengths(specimen, case_directory));
}

std::vector<SetUp> read_set_ups(const ConfigTable& root) {
  const ConfigTable table = root.with_keys(fracture_keys()).table("experiment");
  std::vector<SetUp> set_ups;
  for (const ConfigTable& specimen : table.tables("specimens"))
    set_ups.push_back(read_set_up(Defaults(specimen, table)));
  return set_ups;
}

std::optional<ExperimentSettings> read_experiment(const ConfigTable& root,
                                                  const std::filesystem::path& case_directory) {
  if (!root.has("experiment")) return std::nullopt;
  const ConfigTable table = root.with_keys(fracture_keys()).table("experiment");
  ExperimentSettings settings{.where = table};
  const ConfigValue range = table.at("stiffness_between");
  const std::vector<ConfigValue> ends = range.list(2);
  settings.stiffness_from = ends[0].quantity();
  settings.stiffness_to = ends[1].quantity();
  if (!(settings.stiffness_from < settings.stiffness_to))
    throw range.error("the second displacement must be the larger");
  for (const ConfigTable& specimen : table.tables("specimens")) {
    MeasuredCurve curve = read_specimen(specimen, table, case_directory);
    for (const MeasuredCurve& other : settings.specimens)
      if (other.curve.name == curve.curve.name)
        throw specimen.at("name").error(fmt::format("another specimen is called \"{}\" already", curve.curve.name));
    settings.specimens.push_back(std::move(curve));
  }
  if (settings.specimens.empty())
    throw table.error("no measured curve is named; at least one [[experiment.specimens]] is required");
  settings.events = read_events(table, settings.specimens);
  settings.fields = read_field_settings(table, settings.specimens);
  for (const ConfigTable& energy : table.tables("energies"))
    settings.energies.push_back(read_energy(energy, case_directory));
  for (const ConfigTable& debonding : table.tables("debonding")) {
    settings.angles.push_back(read_angle(debonding, case_directory));
    const MeasuredAngle &first = settings.angles.front(), &last = settings.angles.back();
    if (first.surface != last.surface || first.at_positive != last.at_positive)
      throw debonding.error("all angles must be those of one pole of one surface");
  }
  return settings;
}

}  // namespace pfdm
