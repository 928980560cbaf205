#include "solver/fracture/words/stiffness_words.h"

#include "physics/quantity_text.h"
#include "solver/fracture/gaps/flowing_gaps.h"
#include "solver/fracture/model/relaxing_volume.h"
#include "solver/momentum/bending/confined_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

std::string why_without(const FractureModel& model, const RegionModel& region) {
  if (model.is_anisotropic()) return "beside elasticity that depends on the direction";
  if (!model.is_isotropic()) return "with a split without secant moduli";
  return fmt::format("in a material of the law \"{}\"", region.material ? region.material->name() : "linear_elastic");
}

// The elasticity by which a cell can come to be nearly incompressible; none of materials of finite strain, which have
// pressures of their own, and of elasticity that depends on the direction.
std::optional<IsotropicElasticity> against_volume(const RegionModel& region) {
  if (region.stiffness || (region.material && region.material->is_finite_strain())) return std::nullopt;
  return region.material ? poisson_range(*region.material).greatest : region.elasticity;
}

// Cells that are nearly incompressible, at any time of materials that relax, and have no pressure.
std::optional<std::string> of_volume(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns) {
  const std::vector<Index>& with = unknowns.pressure_cells;  // in rising order
  Index n_without = 0, worst = -1;
  double most = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (std::ranges::binary_search(with, c)) continue;
    const auto by = against_volume(model.in_cell(mesh, c));
    if (!by || !is_nearly_incompressible(*by)) continue;
    ++n_without;
    if (by->poisson_ratio() > most) most = by->poisson_ratio(), worst = c;
  }
  if (n_without == 0) return std::nullopt;
  return fmt::format(
      "region \"{}\" is nearly incompressible (nu = {:.5g}), and {} cells have no pressure unknown {}: where it is "
      "confined the body is too stiff (a bonded disc of hexahedra by 0.5 % at nu = 0.49, by 20 % at 0.4997); compare a "
      "finer mesh, or lower materials.NAME.poisson_ratio",
      mesh.region_names[mesh.region[worst]], most, n_without, why_without(model, model.in_cell(mesh, worst)));
}

// What the layer takes more of for the error to be bearable; with cells at its edges as much shorter.
double refinement(const ConfinedLayer& layer, const IsotropicElasticity& of, double bearable) {
  double times = 1.0;
  while (-layer.error(of, times) > bearable && times < 100.0) times += 0.5;
  return times;
}

// The coarse confined layer of the region in which more than half of the held surface errs by more than is bearable:
// one with the median error.
std::optional<std::string> of_confined_layers(const Mesh& mesh, const Unknowns& unknowns) {
  constexpr double bearable = 0.03, least_ratio = 0.3;
  struct Found {
    ConfinedLayer layer;
    double error = 0.0;  // too soft
  };
  std::vector<std::vector<Found>> regions(mesh.region_names.size());
  for (const ConfinedLayer& layer : confined_layers(mesh, unknowns)) {
    const IsotropicElasticity& of = unknowns.sound[unknowns.zone[layer.cell]];
    if (of.poisson_ratio() >= least_ratio) regions[mesh.region[layer.cell]].push_back({layer, -layer.error(of)});
  }
  std::optional<Found> worst;
  for (std::vector<Found>& in : regions) {
    if (in.empty()) continue;
    std::ranges::sort(in, {}, &Found::error);
    double all = 0.0, below = 0.0;
    for (const Found& at : in) all += at.layer.area;
    auto median = in.begin();
    while (below += median->layer.area, below < 0.5 * all) ++median;
    if (median->error > bearable && (!worst || median->error > worst->error)) worst = *median;
  }
  if (!worst) return std::nullopt;
  const ConfinedLayer& at = worst->layer;
  const IsotropicElasticity& of = unknowns.sound[unknowns.zone[at.cell]];
  const double times = refinement(at, of, bearable);
  const auto length = [](double metres) { return quantity_text(metres, "m", 3); };
  return fmt::format(
      "region \"{}\": {:.3g} layer{} of cells {} long at the edges across {}, {} wide and held on both faces, nu = "
      "{:.3g}: pulled or pressed across, it is about {:.0f} % too soft (its constraint ends within few cells of the "
      "edges; within a third). For {:.0f} %: {:.0f} layers of cells {} long at the edges ([mesh])",
      mesh.region_names[mesh.region[at.cell]], at.layers, at.layers < 1.5 ? "" : "s", length(at.spans[0].cells),
      length(at.thickness), length(at.spans[0].width), of.poisson_ratio(), 100.0 * worst->error, 100.0 * bearable,
      std::ceil(times * at.layers - 0.01), length(at.spans[0].cells / times));
}

// Cells that flow, and whose faces go on bearing elastically what the strain varies within them.
std::optional<std::string> of_flow(const Mesh& mesh, const FractureModel& model) {
  std::vector<Index> n_elastic(mesh.region_names.size(), 0), cell(n_elastic);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Material* material = model.in_cell(mesh, c).material.get();
    if (material == nullptr || !material->flows() || FlowingGaps::can_flow(mesh.shape[c])) continue;
    ++n_elastic[mesh.region[c]];
    cell[mesh.region[c]] = c;
  }
  const auto most = std::ranges::max_element(n_elastic);
  if (most == n_elastic.end() || *most == 0) return std::nullopt;
  const auto region = static_cast<std::size_t>(most - n_elastic.begin());
  return fmt::format(
      "region \"{}\" ({}): faces of {} polyhedra or pyramids bear elastically what the strain varies within a cell: "
      "beyond yield they are too strong, the more the farther they flow (a clamped bar by 10 to 15 % at 1 % of strain, "
      "20 to 30 % at 2 %). For less: tetrahedra or hexahedra ([mesh])",
      mesh.region_names[region], model.in_cell(mesh, cell[region]).material->name(), *most);
}

}  // namespace

std::vector<std::string> stiffness_warnings(const Mesh& mesh, const FractureModel& model) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::optional<std::string>& warning) {
    if (warning) warnings.push_back(*warning);
  };
  if (!model.is_plane_stress() && !model.is_finite_strain()) {
    const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
    add(of_volume(mesh, model, unknowns));
    add(of_confined_layers(mesh, unknowns));
  }
  add(of_flow(mesh, model));
  return warnings;
}

}  // namespace pfdm
