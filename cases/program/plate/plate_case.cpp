#include "cases/program/plate/plate_case.h"

#include "cases/program/input/config/key_member.h"
#include "cases/program/plate/plate_keys.h"

#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/amount.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"
#include "postproc/vibration/vibration_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr PlateWord support_table[] = {
    {"clamped", "moves with the base in all directions"},
    {"pinned", "moves with the base along its motion, free in the other directions"},
    {"symmetry", "plane of symmetry: no normal displacement, no tangential traction"},
};
constexpr PlateWord motion_table[] = {
    {"harmonic", "one frequency, or the first resonance"},
    {"sweep", "slow sweep of one amplitude, the heat averaged over it"},
    {"random", "stationary random acceleration of a constant density in a band"},
};
constexpr PlateWord cooling_table[] = {
    {"convection", "heat transfer to the surroundings, with radiation if there is an emissivity"},
    {"insulation", "a layer, and the air beyond it"},
    {"conductance", "a fixture that conducts to the surroundings"},
    {"temperature", "held at a temperature"},
};

std::vector<std::string> patches_of(const ConfigTable& table) {
  if (table.has("patch")) return {table.string("patch")};
  return table.strings("patches");
}

void require_known(const ConfigTable& table, const std::vector<std::string>& known) {
  if (known.empty()) return;  // an imported mesh, which knows its patches later
  if (const auto one = table.find("patch"))
    one->one_of(known, "patch of the mesh");
  else
    for (const ConfigValue& name : table.at("patches").list()) name.one_of(known, "patch of the mesh");
}

std::vector<ModulusAt> modulus_of_csv(const fs::path& file) {
  const CsvTable table = read_csv(file);
  const auto &f = table.column("frequency_Hz"), &storage = table.column("storage_Pa"), &loss = table.column("loss_Pa");
  std::vector<ModulusAt> rows;
  for (std::size_t i = 0; i < f.size(); ++i) rows.push_back({f[i], storage[i], loss[i] / storage[i]});
  return rows;
}

std::vector<ModulusAt> modulus_of_fit(const fs::path& file) {
  const FitReport fit = read_fit_json(file);
  const auto findings = vibration_findings(fit.own);
  if (!findings || findings->modulus.empty())
    throw InputError(
        fmt::format("{}: this fit tells no Young's modulus over frequency; a mass-material case with "
                    "[sample] does",
                    file.string()));
  std::vector<ModulusAt> rows;
  for (const ModulusRow& row : findings->modulus) rows.push_back({row.frequency, row.storage, row.loss / row.storage});
  return rows;
}

void require_sound(const ConfigValue& value, const std::vector<ModulusAt>& rows) {
  if (rows.empty()) throw value.error("the table has no rows");
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!(rows[i].frequency > 0.0 && rows[i].storage > 0.0 && rows[i].loss_factor > 0.0) ||
        (i > 0 && rows[i].frequency <= rows[i - 1].frequency))
      throw value.error(fmt::format("row {} of the table: frequencies must rise, both moduli must be positive", i + 1));
}

std::vector<ModulusAt> read_modulus(const ConfigTable& table, const fs::path& directory,
                                    std::vector<fs::path>& data_files) {
  const auto modulus = table.find("modulus");
  if (!modulus)
    return {{.frequency = 1.0, .storage = table.quantity("young_modulus"), .loss_factor = table.number("loss_factor")}};
  for (const char* other : {"young_modulus", "loss_factor"})
    if (const auto both = table.find(other)) throw both->error("\"modulus\" gives this already");
  const ConfigTable source = modulus->table();
  const bool is_fit = source.has("fit");
  const fs::path file = read_data_file(source.at(is_fit ? "fit" : "csv"), directory);
  data_files.push_back(file);
  const auto rows = modulus->in_context([&] { return is_fit ? modulus_of_fit(file) : modulus_of_csv(file); });
  require_sound(*modulus, rows);
  return rows;
}

PlateMaterial read_material(const ConfigTable& root, const fs::path& directory, std::vector<fs::path>& data_files) {
  const ConfigTable table = root.table("material");
  PlateMaterial material;
  material.density = table.quantity("density");
  material.poisson_ratio = table.number("poisson_ratio");
  material.modulus = read_modulus(table, directory, data_files);
  if (table.has("conductivity") || root.has("heating"))
    material.heat = {.conductivity = table.quantity("conductivity"),
                     .capacity = material.density * table.quantity("specific_heat")};
  if (const auto temperature = table.find("temperature")) {
    const ConfigTable slopes = temperature->table();
    material.reference = slopes.quantity("reference");
    material.modulus_slope = slopes.quantity("modulus", 0.0);
    material.loss_slope = slopes.quantity("loss_factor", 0.0);
  }
  return material;
}

std::vector<BoundaryCondition> read_supports(const ConfigTable& root, const MeshRecipe& mesh, const Vector& direction) {
  std::vector<BoundaryCondition> supports;
  for (const ConfigTable& table : root.tables("support")) {
    const std::string_view type = choose(table.at("type"), support_types(), "type of support").name;
    require_known(table, mesh.patches);
    for (const std::string& patch : patches_of(table)) {
      BoundaryCondition condition{.patch = patch, .value = {}};
      if (type == "symmetry") condition.kind = BoundaryCondition::Kind::symmetry;
      if (type == "clamped") condition.displacement_prescribed = {true, true, true};
      if (type == "pinned")
        for (Index axis = 0; axis < 3; ++axis)
          condition.displacement_prescribed[axis] = std::abs(direction[axis]) > 0.5;
      supports.push_back(condition);
    }
  }
  return supports;
}

PlateExcitation read_base(const ConfigTable& root) {
  const ConfigTable table = root.table("base");
  PlateExcitation base{.type = std::string(choose(table.at("motion"), base_motions(), "motion of the base").name),
                       .frequency = {}};
  base.level = base.type == "random" ? table.quantity("density") : table.quantity("level");
  if (base.type == "harmonic") {
    if (const auto frequency = table.find("frequency"); frequency && frequency->string() != "resonance")
      base.frequency = frequency->quantity();
    return base;
  }
  base.from = table.quantity("from");
  base.to = table.quantity("to");
  if (base.from >= base.to) throw table.at("to").error("the band must end above \"from\"");
  base.logarithmic = table.choice("law", "linear") == "logarithmic";
  return base;
}

Vector read_direction(const ConfigTable& root) {
  return Vector::Unit(root.table("base").choice("direction", "z")[0] - 'x');
}

void read_response(const ConfigTable& root, PlateCase& c) {
  const ConfigTable table = root.table("response");
  c.from = table.quantity("from");
  c.to = table.quantity("to");
  if (c.from >= c.to) throw table.at("to").error("the response must end above \"from\"");
  read_stored(table, c);
  for (const ConfigTable& point : table.tables("points")) {
    const std::string& name = point.at("name").string();
    if (std::ranges::any_of(c.points, [&](const auto& earlier) { return earlier.name == name; }))
      throw point.at("name").error(fmt::format("there is another point \"{}\"", name));
    c.points.push_back({.name = read_plain_name(point.at("name"), "a column"), .at = read_point(point.at("at"))});
  }
  if (c.points.empty()) throw table.error("it needs [[response.points]], one at least, each with a name and a place");
}

DiffusionBoundary read_cooling(const ConfigTable& table, double surroundings) {
  using Kind = DiffusionBoundary::Kind;
  const std::string_view type = choose(table.at("type"), cooling_types(), "type of cooling").name;
  const auto coefficient = [&] { return table.quantity("coefficient"); };
  if (type == "temperature")
    return {.patch = {}, .kind = Kind::value, .value = table.quantity("temperature") - surroundings};
  DiffusionBoundary boundary{.patch = {}, .kind = Kind::exchange};
  boundary.coefficient = coefficient();
  if (type == "convection" && table.has("emissivity"))
    boundary.coefficient += conductance_of_radiation(table.number("emissivity"), surroundings);
  if (type == "insulation")
    boundary.coefficient =
        conductance_of_insulation(table.quantity("thickness"), table.quantity("conductivity"), boundary.coefficient);
  return boundary;
}

std::optional<PlateHeating> read_heating(const ConfigTable& root, const MeshRecipe& mesh) {
  if (!root.has("heating")) {
    if (!root.tables("cooling").empty()) throw root.error("[[cooling]] needs [heating]");
    return std::nullopt;
  }
  const ConfigTable table = root.table("heating");
  PlateHeating heating;
  heating.duration = table.quantity("duration");
  heating.step = table.quantity("step", heating.duration / 240.0);
  heating.surroundings = table.quantity("surroundings", 293.15);
  heating.surface =
      mesh.patches.empty() ? table.string("surface") : table.at("surface").one_of(mesh.patches, "patch of the mesh");
  for (const ConfigTable& cooling : root.tables("cooling")) {
    DiffusionBoundary boundary = read_cooling(cooling, heating.surroundings);
    require_known(cooling, mesh.patches);
    for (const std::string& patch : patches_of(cooling)) {
      if (std::ranges::find(heating.boundary, patch, &DiffusionBoundary::patch) != heating.boundary.end())
        throw cooling.error(fmt::format("patch \"{}\" is cooled twice", patch));
      boundary.patch = patch;
      heating.boundary.push_back(boundary);
    }
  }
  return heating;
}

}  // namespace

std::span<const PlateWord> support_types() { return support_table; }
std::span<const PlateWord> base_motions() { return motion_table; }
std::span<const PlateWord> cooling_types() { return cooling_table; }

// Beyond its ends the table keeps its last values.
Harmonic PlateMaterial::at(double frequency, double temperature) const {
  const auto above = std::ranges::upper_bound(modulus, frequency, {}, &ModulusAt::frequency);
  ModulusAt here = above == modulus.end() ? modulus.back() : *above;
  if (above != modulus.begin() && above != modulus.end()) {
    const ModulusAt& below = *std::prev(above);
    const double part = std::log(frequency / below.frequency) / std::log(above->frequency / below.frequency);
    here.storage = std::lerp(below.storage, above->storage, part);
    here.loss_factor = std::lerp(below.loss_factor, above->loss_factor, part);
  }
  const double warmer = depends_on_temperature() ? temperature - reference : 0.0;
  const double storage = here.storage / young_modulus() * (1.0 + modulus_slope * warmer);
  const double loss = here.loss_factor * (1.0 + loss_slope * warmer);
  if (!(storage > 0.0 && loss > 0.0))
    throw ComputationError(fmt::format("at {:.4g} K the modulus or the loss factor is not positive", temperature));
  return {.omega = 2.0 * std::numbers::pi * frequency, .factor = {storage, storage * loss}};
}

PlateCase read_plate_case(const ConfigTable& root, const fs::path& case_directory) {
  const ConfigTable table = root.with_keys(plate_keys());
  PlateCase c;
  c.title = table.line("title");
  c.mesh = read_mesh_recipe(table.table("mesh"), {.case_directory = case_directory, .ell = {}});
  c.data_files = c.mesh.data_files;
  c.material = read_material(table, case_directory, c.data_files);
  c.direction = read_direction(table);
  c.supports = read_supports(table, c.mesh, c.direction);
  c.excitation = read_base(table);
  read_response(table, c);
  c.heating = read_heating(table, c.mesh);
  if (table.has("output")) read_stored(table.table("output"), c);
  return c;
}

}  // namespace pfdm
