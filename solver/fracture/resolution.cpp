#include "solver/fracture/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double cells_in_ell = 2.0;  // at least: the discrete toughness is then within 3 % (AT2) of Gc
constexpr double rounding = 1e-9;     // of sizes that come from coordinates
constexpr double long_tail = 2.0;  // half-width over ell at which a profile without end has fallen to 2 % of its energy

// Extent of a cell across its largest face: of a prism layer its thickness, of a brick its shortest edge, of a
// tetrahedron a third of its height; of a rounder polyhedron twice the distance of that face.
double thickness(const Mesh& mesh, Index cell) {
  const auto area = [&](Index f) { return mesh.face_area[f].norm(); };
  const Index largest = std::ranges::max(mesh.faces_of_cell(cell), {}, area);
  const Vector to_face = mesh.face_centre[largest] - mesh.cell_centre[cell];
  return std::min(mesh.cell_volume[cell], 2.0 * std::abs(to_face.dot(mesh.face_area[largest]))) / area(largest);
}

}  // namespace

std::vector<std::string> resolution_warnings(const Mesh& mesh, const FractureModel& model,
                                             std::span<const Band> bands) {
  // Of each region the cell that is the thickest for its ell.
  struct Thickest {
    double thickness = 0.0, ell = 1.0;
  };
  std::vector<Thickest> thickest(model.regions.size());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (!region.damageable) continue;
    Thickest& most = thickest[as_size(mesh.region[c])];
    if (const double h = thickness(mesh, c); h / region.ell > most.thickness / most.ell) most = {h, region.ell};
  }
  std::vector<std::string> warnings;
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    if (thickest[r].thickness > (1.0 + rounding) * thickest[r].ell / cells_in_ell)
      warnings.push_back(fmt::format(
          "region \"{}\": cells are up to {:.3g} m thick, ell is {:.3g} m: a crack in the thick ones would not "
          "be resolved (at most ell/{:g})",
          mesh.region_names[r], thickest[r].thickness, thickest[r].ell, cells_in_ell));
  }
  for (const Band& band : bands) {
    const RegionModel& region = model.regions[as_size(mesh.region_index(band.region))];
    const double half = std::min(model.crack->support, long_tail) * region.ell;
    if (region.damageable && band.width < 2.0 * half)
      warnings.push_back(
          fmt::format("region \"{}\" is {:.3g} m wide: the profile of a crack in it, {:.3g} m with this ell, reaches "
                      "beyond it",
                      band.region, band.width, 2.0 * half));
  }
  return warnings;
}

}  // namespace pfdm
