#include "cases/program/homogenization/debonding_case.h"

#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/homogenization/homogenization_case.h"
#include "cases/program/homogenization/homogenization_keys.h"
#include "cases/program/studies/sweep/sweep_case.h"
#include "solver/homogenization/mean_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pfdm {
namespace {

/// What one point of a path says of a component.
struct Prescribed {
  std::size_t component;
  bool is_stress;
  double value;  // of the tensor: [Pa], or strain
};

Prescribed read_component(const std::string& key, const ConfigValue& value) {
  const auto component = static_cast<std::size_t>(
      std::ranges::find(component_names, std::string_view(key).substr(key.size() - 2)) - component_names.begin());
  if (key.starts_with("stress")) return {component, true, value.quantity()};
  const double strain = value.is_string() ? value.quantity() : value.number(range::any);
  if (std::abs(strain) >= 1.0)
    throw value.error(
        fmt::format("a strain has to be between -1 and 1, found {:g}{}", strain,
                    value.is_string() ? "" : fmt::format("; if it is in percent, write \"{:g} %\"", strain)));
  return {component, false, key.starts_with("gamma") ? 0.5 * strain : strain};
}

std::vector<Prescribed> read_point_of_path(const ConfigValue& value) {
  const ConfigTable table = value.table();
  std::vector<Prescribed> point;
  std::set<std::size_t> seen;
  for (const auto& [key, entry] : table.entries()) {
    point.push_back(read_component(key, table.at(key)));
    if (!seen.insert(point.back().component).second)
      throw entry.error("this component is prescribed already: stress or strain, not both");
  }
  return point;
}

void add_point(const ConfigValue& where, const std::vector<Prescribed>& point, MeanPath& path) {
  std::array<double, 6> values{};
  std::array<bool, 6> by_stress;
  by_stress.fill(true);
  for (const Prescribed& one : point) {
    values[one.component] = one.value;
    by_stress[one.component] = one.is_stress;
  }
  if (path.points.empty()) path.by_stress = by_stress;
  if (by_stress != path.by_stress)
    throw where.error(
        "every point has to prescribe the strain of the same components as the first (a component that is not named is "
        "free of stress)");
  path.points.push_back(values);
}

// `component`: of both, the first one that is not zero.
MeanPath read_path(const ConfigValue& value, std::array<int, 2>& component) {
  MeanPath path;
  const auto is_loaded = [](const Prescribed& one) { return one.value != 0.0; };
  bool has_load = false;
  for (const ConfigValue& entry : value.list()) {
    const std::vector<Prescribed> point = read_point_of_path(entry);
    const auto first = std::ranges::find_if(point, is_loaded);
    if (!has_load && first != point.end()) {
      component = component_places[first->component];
      has_load = true;
    }
    add_point(entry, point, path);
  }
  if (!has_load) throw value.error("nothing is loaded: name strains or stresses, as in [{ strain_zz = \"5 %\" }]");
  return path;
}

BoxMotion motion_of(const MeanPath& path, const Loading& loading, const Mesh& mesh, const FractureModel& model) {
  CellField<IsotropicElasticity> cells(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) cells[c] = model.in_cell(mesh, c).elasticity;
  return motion_along(path, mesh, loading, reuss_estimate(mesh, cells));
}

/// The path's points are reached at the load parameters 1, 2, ...
void fit_loading(const ConfigTable& root, std::size_t n_points, LoadingSettings& loading) {
  const auto last = static_cast<double>(n_points);
  const bool has_end = root.has("loading") && root.table("loading").has("end");
  if (!has_end) loading.end = last;
  if (loading.end > last)
    throw root.table("loading").at("end").error(
        fmt::format("the path ends at the load parameter {}, the number of its points", n_points));
  loading.is_proportional = n_points == 1;
  if (!loading.is_proportional && std::isfinite(loading.energy_release))
    throw root.table("loading")
        .at("energy_release")
        .error("it requires a path of one point: mean strains and stresses proportional to the load parameter");
}

void add_corners(LoadingSettings& loading) {
  for (double corner = 1.0; corner < loading.end; corner += 1.0) loading.stops.push_back(corner);
  std::ranges::sort(loading.stops);
  loading.stops.erase(std::ranges::unique(loading.stops).begin(), loading.stops.end());
}

}  // namespace

bool has_mean_path(const ConfigTable& root) {
  return root.has("homogenization") && root.table("homogenization").has("path");
}

FractureCase read_debonding_case(const ConfigTable& root, const std::filesystem::path& case_directory, MeshOf mesh) {
  refuse_free_strains(root);
  root.with_keys(debonding_keys());
  const ConfigTable table = root.table("homogenization");
  const auto boundary = table.find("boundary");
  const Loading& loading = boundary
                               ? choose(*boundary, homogenization_loadings(), "boundary condition of a homogenisation")
                               : homogenization_loadings().front();
  if (loading.by_traction)
    throw boundary->error("a path of mean strains and stresses needs \"periodic\" or \"uniform displacement\"");
  if (root.has("initial") && !root.has("fracture"))
    throw root.at("initial").error("damage needs [fracture]: without it only interfaces break");
  BoxCase box;
  const MeanPath path = read_path(table.at("path"), box.component);
  box.motion = [path, &loading](const Mesh& on, const FractureModel& model) {
    return motion_of(path, loading, on, model);
  };
  box.words = fmt::format("{} point{} of mean strain and stress, {}", path.points.size(),
                          path.points.size() == 1 ? "" : "s", loading.name);
  FractureCase fracture = read_body(root, case_directory, true);
  fit_loading(root, path.points.size(), fracture.loading);
  fracture.box = std::move(box);
  read_box_output(root, fracture, mesh);
  add_corners(fracture.loading);
  return fracture;
}

FractureCase read_whole_debonding_case(const CaseFile& file, MeshOf mesh) {
  FractureCase box = read_debonding_case(file.config.root(), file.directory, mesh);
  read_sweep(file);
  file.config.reject_unknown_keys();
  return box;
}

}  // namespace pfdm
