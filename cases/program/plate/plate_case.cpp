#include "cases/program/plate/plate_case.h"

#include "cases/program/input/amount.h"
#include "cases/program/input/heat_units.h"
#include "cases/program/input/path_reader.h"
#include "postproc/curves/fit_json.h"
#include "postproc/files/csv_table.h"
#include "postproc/vibration/vibration_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr Range loss_range{0.0, 2.0, true, "above 0 and below 2"};
constexpr Range counts{2.0, 100000.0, false, "between 2 and 100000"};
constexpr Range mode_count{1.0, 100.0, false, "between 1 and 100"};
constexpr Range frame_count{1.0, 1000.0, false, "between 1 and 1000"};

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
    return {{.frequency = 1.0,
             .storage = table.quantity("young_modulus", dimension::stress, range::positive),
             .loss_factor = table.number("loss_factor", loss_range)}};
  for (const char* other : {"young_modulus", "loss_factor"})
    if (const auto both = table.find(other)) throw both->error("\"modulus\" gives this already");
  const ConfigTable source = modulus->table().with_keys({"csv", "fit"});
  const bool is_fit = source.has("fit");
  const fs::path file = read_data_file(source.at(is_fit ? "fit" : "csv"), directory);
  data_files.push_back(file);
  const auto rows = modulus->in_context([&] { return is_fit ? modulus_of_fit(file) : modulus_of_csv(file); });
  require_sound(*modulus, rows);
  return rows;
}

PlateMaterial read_material(const ConfigTable& root, const fs::path& directory, std::vector<fs::path>& data_files) {
  const ConfigTable table = root.table("material")
                                .with_keys({"density", "poisson_ratio", "young_modulus", "loss_factor", "modulus",
                                            "conductivity", "specific_heat", "temperature"});
  PlateMaterial material;
  material.density = table.quantity("density", dimension::density, range::positive);
  material.poisson_ratio = table.number("poisson_ratio", range::poisson_ratio);
  material.modulus = read_modulus(table, directory, data_files);
  if (table.has("conductivity") || root.has("heating"))
    material.heat = {
        .conductivity = table.quantity("conductivity", dimension::conductivity, range::positive),
        .capacity = material.density * table.quantity("specific_heat", dimension::specific_heat, range::positive)};
  if (const auto temperature = table.find("temperature")) {
    const ConfigTable slopes = temperature->table().with_keys({"reference", "modulus", "loss_factor"});
    material.reference = slopes.quantity("reference", dimension::temperature, range::positive);
    material.modulus_slope = slopes.quantity("modulus", dimension::per_temperature, range::any, 0.0);
    material.loss_slope = slopes.quantity("loss_factor", dimension::per_temperature, range::any, 0.0);
  }
  return material;
}

std::vector<BoundaryCondition> read_supports(const ConfigTable& root, const MeshRecipe& mesh, const Vector& direction) {
  std::vector<BoundaryCondition> supports;
  for (const ConfigTable& table : root.tables("support")) {
    table.with_keys({"patch", "patches", "type"});
    const std::string_view type = choose(table.at("type"), support_types(), "type of support").name;
    require_known(table, mesh.patches);
    for (const std::string& patch : patches_of(table)) {
      BoundaryCondition condition{.patch = patch, .value = {}};
      if (type == "symmetry") condition.kind = BoundaryCondition::Kind::symmetry;
      if (type == "clamped") condition.displacement_prescribed = {true, true, true};
      if (type == "pinned")
        for (Index axis = 0; axis < 3; ++axis)
          condition.displacement_prescribed[as_size(axis)] = std::abs(direction[axis]) > 0.5;
      supports.push_back(condition);
    }
  }
  return supports;
}

PlateExcitation read_base(const ConfigTable& root) {
  const ConfigTable table =
      root.table("base").with_keys({"motion", "direction", "level", "density", "frequency", "from", "to", "law"});
  PlateExcitation base{.type = std::string(choose(table.at("motion"), base_motions(), "motion of the base").name),
                       .frequency = {}};
  base.level = base.type == "random" ? table.quantity("density", dimension::acceleration_density, range::positive)
                                     : table.quantity("level", dimension::acceleration, range::positive);
  if (base.type == "harmonic") {
    if (const auto frequency = table.find("frequency"); frequency && frequency->string() != "resonance")
      base.frequency = frequency->quantity(dimension::frequency, range::positive);
    return base;
  }
  base.from = table.quantity("from", dimension::frequency, range::positive);
  base.to = table.quantity("to", dimension::frequency, range::positive);
  if (base.from >= base.to) throw table.at("to").error("the band must end above \"from\"");
  const std::string laws[] = {"linear", "logarithmic"};
  if (const auto law = table.find("law")) base.logarithmic = law->one_of(laws, "law of a sweep") == "logarithmic";
  return base;
}

Vector read_direction(const ConfigTable& root) {
  const std::string axes[] = {"x", "y", "z"};
  const auto direction = root.table("base").find("direction");
  return Vector::Unit(direction ? direction->one_of(axes, "axis")[0] - 'x' : 2);
}

void read_response(const ConfigTable& root, PlateCase& c) {
  const ConfigTable table = root.table("response").with_keys({"from", "to", "frequencies", "modes", "points"});
  c.from = table.quantity("from", dimension::frequency, range::positive);
  c.to = table.quantity("to", dimension::frequency, range::positive);
  if (c.from >= c.to) throw table.at("to").error("the response must end above \"from\"");
  c.n_frequencies = static_cast<int>(table.integer("frequencies", counts, 200));
  c.n_modes = static_cast<int>(table.integer("modes", mode_count, 6));
  for (const ConfigTable& point : table.tables("points")) {
    point.with_keys({"name", "at"});
    const std::string& name = point.at("name").string();
    if (std::ranges::any_of(c.points, [&](const auto& earlier) { return earlier.name == name; }))
      throw point.at("name").error(fmt::format("there is another point \"{}\"", name));
    c.points.push_back({.name = read_plain_name(point.at("name"), "a column"), .at = read_point(point.at("at"))});
  }
  if (c.points.empty()) throw table.error("it needs [[response.points]], one at least, each with a name and a place");
}

DiffusionBoundary read_cooling(const ConfigTable& table, double surroundings) {
  using Kind = DiffusionBoundary::Kind;
  table.with_keys(
      {"patch", "patches", "type", "coefficient", "emissivity", "thickness", "conductivity", "temperature"});
  const std::string_view type = choose(table.at("type"), cooling_types(), "type of cooling").name;
  const auto coefficient = [&] { return table.quantity("coefficient", dimension::heat_transfer, range::positive); };
  if (type == "temperature")
    return {.patch = {},
            .kind = Kind::value,
            .value = table.quantity("temperature", dimension::temperature, range::positive) - surroundings};
  DiffusionBoundary boundary{.patch = {}, .kind = Kind::exchange};
  boundary.coefficient = coefficient();
  if (type == "convection" && table.has("emissivity"))
    boundary.coefficient += conductance_of_radiation(table.number("emissivity", range::fraction), surroundings);
  if (type == "insulation")
    boundary.coefficient = conductance_of_insulation(
        table.quantity("thickness", dimension::length, range::positive),
        table.quantity("conductivity", dimension::conductivity, range::positive), boundary.coefficient);
  return boundary;
}

std::optional<PlateHeating> read_heating(const ConfigTable& root, const MeshRecipe& mesh) {
  if (!root.has("heating")) {
    if (!root.tables("cooling").empty()) throw root.error("[[cooling]] needs [heating]");
    return std::nullopt;
  }
  const ConfigTable table = root.table("heating").with_keys({"duration", "step", "surroundings", "surface"});
  PlateHeating heating;
  heating.duration = table.quantity("duration", dimension::time, range::positive);
  heating.step = table.quantity("step", dimension::time, range::positive, heating.duration / 240.0);
  heating.surroundings = table.quantity("surroundings", dimension::temperature, range::positive, 293.15);
  heating.surface =
      mesh.patches.empty() ? table.string("surface") : table.at("surface").one_of(mesh.patches, "patch of the mesh");
  for (const ConfigTable& cooling : root.tables("cooling")) {
    DiffusionBoundary boundary = read_cooling(cooling, heating.surroundings);
    require_known(cooling, mesh.patches);
    for (const std::string& patch : patches_of(cooling)) {
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
  const ConfigTable table = root.with_keys({"kind", "title", "mesh", "material", "support", "base", "response",
                                            "heating", "cooling", "output", "fit", "sweep"});
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
  if (table.has("output"))
    c.n_frames =
        static_cast<int>(table.table("output").with_keys({"frames"}).integer("frames", frame_count, c.n_frames));
  return c;
}

}  // namespace pfdm
