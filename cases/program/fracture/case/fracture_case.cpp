#include "cases/program/fracture/case/fracture_case.h"

#include "cases/program/fracture/body/fatigue_case.h"
#include "cases/program/fracture/case/model_choice.h"
#include "cases/program/fracture/case/run_keys.h"
#include "cases/program/input/config/key_member.h"
#include "physics/quantity_text.h"
#include "solver/fracture/model/toughness_perturbation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>

namespace pfdm {
namespace {

std::string unsuited_split(const Material& material, const EnergySplit& split) {
  return fmt::format("a material of the law \"{}\" cannot be combined with the energy split \"{}\"; allowed: {}",
                     material.name(), split.name(), splits_with_secant());
}

/// What materials with a history ask of the splits and of the loading.
void check_histories(const FractureCase& fracture, const ConfigTable& root) {
  std::vector<EnergySplit> splits{fracture.model.split};
  for (const RegionMaterial& region : fracture.materials.by_region)
    if (region.split.is_chosen()) splits.push_back(region.split);
  const auto unsuited = std::ranges::find_if(splits, [](const EnergySplit& split) { return !split.has_secant(); });
  for (const RegionMaterial& region : fracture.materials.by_region) {
    if (!region.material) continue;
    const bool is_small_strain = !region.material->is_finite_strain();  // the others have splits of their own
    if (is_small_strain && unsuited != splits.end())
      throw region.where.error(unsuited_split(*region.material, *unsuited));
    if (region.material->depends_on_rate() && !(fracture.loading.duration > 0.0))
      throw region.where.error(
          "a law that depends on the rate requires the time in which the load parameter grows by 1: duration = \"1 s\" "
          "in "
          "[loading]");
    if (fracture.loading.controls_dissipation())
      throw root.table("loading")
          .at("maximum_dissipation")
          .error(fmt::format("it cannot be combined with materials of the law \"{}\": their displacements are not "
                             "proportional to the load",
                             region.material->name()));
  }
}

/// What interfaces whose law depends on the rate ask of the loading.
void check_rates(const FractureCase& fracture, const ConfigTable& root) {
  for (const InterfaceSettings& interface : fracture.interfaces) {
    if (!interface.law.depends_on_rate()) continue;
    if (!(fracture.loading.duration > 0.0))
      throw interface.where.at(interface.law.rate.any() ? "rate" : "branches")
          .error(
              "an interface whose law depends on the rate requires the time in which the load parameter grows by 1: "
              "duration = \"1 s\" in [loading]");
    if (fracture.loading.controls_dissipation())
      throw root.table("loading")
          .at("maximum_dissipation")
          .error(fmt::format("it cannot be combined with the rate of interface \"{}\": the load may decrease, time "
                             "cannot",
                             interface.name));
  }
}

void check_time(const ConfigTable& table, const FractureModel& model) {
  if (!(model.viscosity > 0.0)) return;
  if (!table.has("duration"))
    throw table.error(
        "fracture.viscosity requires the time in which the load parameter grows by 1: duration = \"1 s\"");
  if (table.has("maximum_dissipation"))
    throw table.at("maximum_dissipation")
        .error("it cannot be combined with fracture.viscosity: the load may decrease, time cannot");
}

LoadingSettings read_loading(const ConfigTable& root, const FractureModel& model) {
  LoadingSettings loading;
  if (!root.has("loading")) {
    if (model.viscosity > 0.0) throw root.error("fracture.viscosity needs the table [loading] with a duration");
    return loading;
  }
  const ConfigTable table = root.table("loading");
  read_stored(table, loading);
  if (!table.has("maximum_increment"))
    loading.maximum_increment = std::max(loading.maximum_increment, loading.initial_increment);
  if (loading.minimum_increment > loading.initial_increment || loading.initial_increment > loading.maximum_increment)
    throw table.error(fmt::format("expected minimum <= initial <= maximum of the increments, found {}, {}, {}",
                                  loading.minimum_increment, loading.initial_increment, loading.maximum_increment));
  check_time(table, model);
  return loading;
}

StaggeredSettings read_solver(const ConfigTable& root) {
  StaggeredSettings settings;
  if (!root.has("solver")) return settings;
  const ConfigTable table = root.table("solver");
  read_stored(table, settings);
  if (table.has("linear")) settings.linear = &choose(table.at("linear"), linear_solvers(), "linear solver");
  return settings;
}

void read_curve_patch(const ConfigTable& output, FractureCase& fracture) {
  const ConfigTable curve = output.table("curve");
  fracture.curve_patch = curve.at("patch");
  fracture.output.curve.patch = curve.string("patch");
  fracture.output.curve.component = curve.choice("component")[0] - 'x';
}

/// Names that the file uses against those that the mesh has; an empty list means that they are not known yet.
void check_names(const FractureCase& fracture, std::span<const std::string> regions,
                 std::span<const std::string> patches) {
  if (!regions.empty())
    for (const RegionMaterial& material : fracture.materials.by_region)
      material.where.one_of(regions, "region of the mesh");
  if (!regions.empty() && fracture.initial_damage)
    for (const ConfigValue& region : fracture.initial_damage->regions) region.one_of(regions, "region of the mesh");
  if (patches.empty() || fracture.box) return;
  for (const BoundarySettings& boundary : fracture.boundary) boundary.patch.one_of(patches, "patch of the mesh");
  fracture.curve_patch->one_of(patches, "patch of the mesh");
}

/// The load parameter at which the curve's patch has been displaced by `entry`.
double load_at_displacement(const ConfigValue& entry, const FractureCase& fracture) {
  if (fracture.box)
    throw entry.error("give load parameters, as in 0.78: the points of the path are reached at 1, 2, ...");
  if (const auto full = full_displacement(fracture)) return entry.quantity() / *full;
  throw entry.error(
      fmt::format("the displacement of patch \"{}\" along the curve's component is not prescribed by a "
                  "plain quantity; give load parameters, as in 0.78",
                  fracture.output.curve.patch));
}

std::string end_words(const FractureCase& fracture) {
  const auto full = fracture.box ? std::nullopt : full_displacement(fracture);
  return full ? fmt::format(" ({})", quantity_text(*full * fracture.loading.end, "m")) : "";
}

std::vector<double> read_frames(const ConfigTable& output, const FractureCase& fracture) {
  std::vector<double> loads;
  const auto frames = output.find("frames_at");
  if (!frames) return loads;
  if (fracture.loading.controls_dissipation())
    throw frames->error(
        "with loading.maximum_dissipation the load may pass a value more than once; use frames_every = 10, for every "
        "tenth step");
  for (const ConfigValue& entry : frames->list()) {
    const double load = entry.is_string() ? load_at_displacement(entry, fracture) : entry.number();
    if (!(load > 0.0) || load > fracture.loading.end * (1.0 + 1e-12))
      throw entry.error(fmt::format("this is at load parameter {:.6g}; the loading goes from 0 to {:.6g}{}", load,
                                    fracture.loading.end, end_words(fracture)));
    loads.push_back(std::min(load, fracture.loading.end));
  }
  std::sort(loads.begin(), loads.end());
  loads.erase(std::unique(loads.begin(), loads.end()), loads.end());
  return loads;
}

void read_frames_of(const ConfigTable& output, FractureCase& fracture) {
  fracture.loading.stops = read_frames(output, fracture);
  fracture.output.frames = read_frame_settings(output, fracture.loading, full_displacement(fracture));
  fracture.output.frames_every = static_cast<Index>(output.integer("frames_every", std::int64_t{0}));
  if (const auto point = output.find("slices_through")) fracture.output.slices_through = read_point(*point);
}

void read_output(const ConfigTable& root, FractureCase& fracture, MeshOf mesh) {
  const ConfigTable output = root.table("output");
  read_curve_patch(output, fracture);
  if (mesh == MeshOf::the_case)  // the frames need the curve's patch
    check_names(fracture, fracture.mesh.regions, fracture.mesh.patches);
  read_frames_of(output, fracture);
  fracture.output.tips = read_energy_release(output, fracture.model.boundary);
}

/// Which traction-separation laws are recorded.
void read_columns(const ConfigTable& root, FractureCase& fracture) {
  std::vector<std::string> interfaces;
  for (const InterfaceSettings& interface : fracture.interfaces) interfaces.push_back(interface.name);
  fracture.cohesive =
      read_cohesive(root, fracture.materials.bands, interfaces, Vector::Unit(fracture.output.curve.component));
}

std::vector<double> loads_to_try(const LoadingSettings& loading) {
  std::vector<double> loads{0.0, loading.initial_increment, loading.end};
  loads.insert(loads.end(), loading.stops.begin(), loading.stops.end());
  return loads;
}

/// Expressions are evaluated once where and when they will be, so that one without a value is refused before a run has
/// taken time, and the place of earlier results.
void require_boundary_values(const FractureCase& fracture, const Mesh& mesh, std::span<const double> loads) {
  for (const BoundarySettings& boundary : fracture.boundary) {
    const BoundaryCondition& condition = boundary.condition;
    const Patch& patch = mesh.patch(condition.patch);
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      for (const double load : loads) {
        if (condition.value) condition.value(mesh.face_centre[f], load);
        if (condition.pressure) condition.pressure(mesh.face_centre[f], load);
      }
  }
}

/// One-way, what expands does so by [loads] alone.
void give_heat(FractureCase& fracture) {
  fracture.model.heat = fracture.heat;
  if (fracture.heat->is_two_way) return;
  const auto expands = [](const RegionMaterial& region) {
    return !region.varies && !region.at(Vector::Zero()).expansion.isZero();
  };
  const auto found = std::ranges::find_if(fracture.materials.by_region, expands);
  if (found == fracture.materials.by_region.end()) return;
  fracture.materials.remarks.push_back(fmt::format(
      "region \"{}\" expands by [loads] temperature_change alone: the temperatures of [heat] make no strains "
      "(heat.coupling = \"two_way\" has them)",
      found->region));
}

}  // namespace

std::optional<double> full_displacement(const FractureCase& fracture) {
  const CurveSettings& curve = fracture.output.curve;
  for (const BoundarySettings& boundary : fracture.boundary) {
    if (boundary.condition.patch != curve.patch) continue;
    const auto full = boundary.displacement_at_full_load[curve.component];
    if (full && *full != 0.0) return full;
  }
  return std::nullopt;
}

FractureCase read_fracture_case(const ConfigTable& root, const std::filesystem::path& case_directory, MeshOf mesh) {
  root.with_keys(fracture_keys());
  FractureCase fracture = read_body(root, case_directory, false);
  fracture.boundary = read_boundary(root, fracture.materials);
  fracture.model.loads = read_body_loads(root);
  fracture.heat = read_heat(root, fracture.loading);
  if (fracture.heat) give_heat(fracture);
  fracture.model.fatigue_cycles = read_fatigue_cycles(root, fracture.materials);
  for (const BoundarySettings& boundary : fracture.boundary) fracture.model.boundary.push_back(boundary.condition);
  read_output(root, fracture, mesh);
  read_columns(root, fracture);
  return fracture;
}

FractureCase read_body(const ConfigTable& root, const std::filesystem::path& case_directory, bool may_be_elastic) {
  FractureCase fracture;
  fracture.title = root.line("title");
  MaterialDefaults defaults = may_be_elastic && !root.has("fracture") ? elastic_model(fracture.model)
                                                                      : read_fracture_model(root, fracture.model);
  fracture.mesh = read_mesh_recipe(root.table("mesh"), {case_directory, defaults.ell});
  defaults.bands = fracture.mesh.bands;
  defaults.loads_from_start = !may_be_elastic && apply_from_start(root);
  fracture.file = root;
  fracture.materials = read_materials(root, defaults);
  fracture.perturbation = read_perturbation(root);
  fracture.initial_damage = read_initial_damage(root, fracture.model);
  fracture.interfaces = read_interfaces(root, case_directory, fracture.data_files);
  fracture.loading = read_loading(root, fracture.model);
  check_histories(fracture, root);
  check_rates(fracture, root);
  fracture.staggered = read_solver(root);
  return fracture;
}

void read_box_output(const ConfigTable& root, FractureCase& fracture, MeshOf mesh) {
  if (mesh == MeshOf::the_case) check_names(fracture, fracture.mesh.regions, {});
  fracture.output.curve.component = fracture.box->component[0];
  if (root.has("output")) read_frames_of(root.table("output"), fracture);
  read_columns(root, fracture);
}

FractureModel model_on(const FractureCase& fracture, const Mesh& mesh) {
  std::vector<std::string> patches;
  for (const Patch& patch : mesh.patches) patches.push_back(patch.name);
  check_names(fracture, mesh.region_names, patches);
  const std::vector<double> loads = loads_to_try(fracture.loading);
  require_boundary_values(fracture, mesh, loads);
  for (const TipRegion& region : fracture.output.tips) require_ring(mesh, region);
  FractureModel model = fracture.model;
  place_materials(fracture.materials, mesh, model);
  require_body_loads(*fracture.file, model, mesh, loads);
  if (!fracture.output.tips.empty() && (model.has_body_force() || model.has_eigenstrain()))
    throw InputError(
        "[[output.energy_release_rate]] cannot be combined with body forces or eigenstrains: the integral over the "
        "ring does not have their part");
  for (const TipRegion& region : fracture.output.tips)
    if (region.reference_length > 0.0 && model.is_anisotropic())
      throw InputError(fmt::format(
          "[[output.energy_release_rate]] \"{}\": there are no stress intensities where elasticity depends on the "
          "direction; leave out reference_length",
          region.name));
  if (const Perturbation& by = fracture.perturbation; by.part > 0.0) perturb_toughness(mesh, by.part, by.seed, model);
  place_interfaces(fracture.interfaces, mesh, model);
  if (fracture.initial_damage) model.initial_damage = damage_at_the_start(*fracture.initial_damage, model, mesh);
  if (fracture.box) model.motion = fracture.box->motion(mesh, model);
  return model;
}

}  // namespace pfdm
