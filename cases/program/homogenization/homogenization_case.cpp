#include "cases/program/homogenization/homogenization_case.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/homogenization/homogenization_keys.h"
#include "cases/program/input/config/key_member.h"
#include "cases/program/studies/sweep/sweep_case.h"
#include "solver/momentum/body/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

void refuse_keys_of_paths(const ConfigTable& root) {
  constexpr std::string_view path = "[homogenization] path";
  root.refuse_keys_beyond(composite_keys(), debonding_keys(), path);
  if (root.has("materials"))
    for (const auto& [name, material] : root.table("materials").entries())
      material.table().refuse_keys_beyond(composite_material_keys(), material_keys(), path);
  root.with_keys(composite_keys());
}

// After read_materials(), which says what keys there are.
std::vector<CompositeMaterial> read_other_keys(const ConfigTable& root) {
  std::vector<CompositeMaterial> materials;
  for (const auto& [name, value] : root.table("materials").entries()) {
    const ConfigTable table = value.table();
    CompositeMaterial material{.name = name, .regions = table.strings("regions"), .density = {}};
    if (table.has("density")) material.density = table.quantity("density");
    material.loss_factor = table.number("loss_factor", 0.0);
    materials.push_back(std::move(material));
  }
  return materials;
}

HomogenizationSettings read_settings(const ConfigTable& root) {
  HomogenizationSettings settings{.loading = &homogenization_loadings().front()};
  if (root.has("homogenization")) {
    const ConfigTable table = root.table("homogenization");
    if (const auto boundary = table.find("boundary"))
      settings.loading = &choose(*boundary, homogenization_loadings(), "boundary condition of a homogenisation");
  }
  if (root.has("solver")) {
    const ConfigTable table = root.table("solver");
    read_stored(table, settings);
    if (const auto linear = table.find("linear")) settings.linear = &choose(*linear, linear_solvers(), "linear solver");
  }
  return settings;
}

}  // namespace

void refuse_free_strains(const ConfigTable& root) {
  for (const char* table : {"materials", "regions"}) {
    if (!root.has(table)) continue;
    for (const auto& [name, of_name] : root.table(table).entries())
      for (const char* key : {"expansion", "eigenstrain", "temperature_shift"})
        if (of_name.is_table() && of_name.table().has(key))
          throw of_name.table().at(key).error(
              "a box that follows its mean strain has no temperature and no eigenstrains; cases of kind \"fracture\" "
              "have");
  }
}

HomogenizationCase read_homogenization_case(const ConfigTable& root, const std::filesystem::path& case_directory,
                                            MeshOf mesh) {
  refuse_free_strains(root);
  refuse_keys_of_paths(root);
  HomogenizationCase homogenization;
  homogenization.title = root.line("title");
  homogenization.mesh = read_mesh_recipe(root.table("mesh"), {.case_directory = case_directory, .ell = {}});
  MaterialDefaults defaults;
  defaults.elastic_keys = composite_material_keys;
  homogenization.materials = read_materials(root, defaults);
  homogenization.by_name = read_other_keys(root);
  if (mesh == MeshOf::the_case && !homogenization.mesh.regions.empty())
    for (const RegionMaterial& material : homogenization.materials.by_region)
      material.where.one_of(homogenization.mesh.regions, "region of the mesh");
  homogenization.settings = read_settings(root);
  return homogenization;
}

HomogenizationCase read_whole_homogenization_case(const CaseFile& file, MeshOf mesh) {
  HomogenizationCase homogenization = read_homogenization_case(file.config.root(), file.directory, mesh);
  read_sweep(file);
  file.config.reject_unknown_keys();
  return homogenization;
}

LinearComposite composite_on(const HomogenizationCase& homogenization, const Mesh& mesh) {
  FractureModel model;
  place_materials(homogenization.materials, mesh, model);
  ElasticBody body = elastic_body(model);
  LinearComposite composite{.elasticity = std::move(body.elasticity), .zone = std::move(body.zone)};
  composite.stiffness = std::move(body.stiffness);
  if (model.cells.size() == 0) return composite;
  composite.cells = CellField<IsotropicElasticity>(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) composite.cells[c] = model.cells[c].elasticity;
  return composite;
}

std::optional<std::string> warning_of_volume(const LinearComposite& composite, const Mesh& mesh) {
  if (!composite.stiffness) return std::nullopt;
  Index worst = -1;
  double most = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const IsotropicElasticity& elasticity =
        composite.cells.size() > 0 ? composite.cells[c] : composite.elasticity[mesh.region[c]];
    if (composite.stiffness(mesh, c) != nullptr || !is_nearly_incompressible(elasticity)) continue;
    if (const double nu = elasticity.poisson_ratio(); nu > most) most = nu, worst = c;
  }
  if (worst < 0) return std::nullopt;
  return fmt::format(
      "region \"{}\" is nearly incompressible (nu = {:.5g}) beside elasticity that depends on the direction: no cell "
      "has a pressure unknown. K was 4 % too low and G 5 to 8 % too high so (coarse tetrahedra, nu = 0.49, 0.499); "
      "compare a finer mesh, or lower poisson_ratio",
      mesh.region_names[mesh.region[worst]], most);
}

std::vector<Phase> phases_of(const HomogenizationCase& homogenization, const Mesh& mesh, const Homogenized& result) {
  std::vector<Phase> phases;
  double sum = 0.0;
  for (const CompositeMaterial& material : homogenization.by_name) {
    const auto named = std::ranges::find(homogenization.materials.by_name, material.name, &NamedElasticity::material);
    if (!named->elasticity) return {};
    double fraction = 0.0;
    for (const std::string& region : material.regions) fraction += result.fraction[mesh.region_index(region)];
    phases.push_back({fraction, *named->elasticity});
    sum += fraction;
  }
  constexpr double rounding = 1e-6;
  return std::abs(sum - 1.0) < rounding ? phases : std::vector<Phase>{};
}

}  // namespace pfdm
