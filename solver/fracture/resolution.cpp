#include "solver/fracture/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double cells_in_ell = 2.0;  // at least: the discrete toughness is then within 3 % (AT2) of Gc
// Along a band: with edges of ell the force after a bead's debonding is within 1 % of that of finer ones. Layers
// around a sphere widen outwards.
constexpr double widest_in_ell = 1.25;
constexpr double rounding = 1e-9;  // of sizes that come from coordinates
constexpr double long_tail = 2.0;  // half-width over ell at which a profile without end has fallen to 2 % of its energy

// Extent of a cell across its largest face: of a prism layer its thickness, of a brick its shortest edge, of a
// tetrahedron a third of its height; of a rounder polyhedron twice the distance of that face.
double thickness(const Mesh& mesh, Index cell) {
  const auto area = [&](Index f) { return mesh.face_area[f].norm(); };
  const Index largest = std::ranges::max(mesh.faces_of_cell(cell), {}, area);
  const Vector to_face = mesh.face_centre[largest] - mesh.cell_centre[cell];
  return std::min(mesh.cell_volume[cell], 2.0 * std::abs(to_face.dot(mesh.face_area[largest]))) / area(largest);
}

// Edge of a cell along its largest face, if that is a regular triangle or a square.
double width(const Mesh& mesh, Index cell) {
  const auto area = [&](Index f) { return mesh.face_area[f].norm(); };
  const Index largest = std::ranges::max(mesh.faces_of_cell(cell), {}, area);
  const bool is_triangle = mesh.points_of_face(largest).size() == 3;
  return std::sqrt(area(largest) * (is_triangle ? 4.0 / std::numbers::sqrt3 : 1.0));
}

// Of each region the cell that is the thickest for its ell, and the means of width and ell over its cells.
struct Sizes {
  double thickness = 0.0, ell = 1.0;  // [m]
  double width = 0.0, mean_ell = 0.0, n_cells = 0.0;
};
std::vector<Sizes> sizes_by_region(const Mesh& mesh, const FractureModel& model) {
  std::vector<Sizes> sizes(model.regions.size());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (!region.damageable) continue;
    Sizes& of_region = sizes[as_size(mesh.region[c])];
    if (const double h = thickness(mesh, c); h / region.ell > of_region.thickness / of_region.ell)
      of_region.thickness = h, of_region.ell = region.ell;
    of_region.width += width(mesh, c);
    of_region.mean_ell += region.ell;
    of_region.n_cells += 1.0;
  }
  return sizes;
}

}  // namespace

std::vector<std::string> resolution_warnings(const Mesh& mesh, const FractureModel& model,
                                             std::span<const Band> bands) {
  std::vector<std::string> warnings;
  const std::vector<Sizes> sizes = sizes_by_region(mesh, model);
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    if (sizes[r].thickness > (1.0 + rounding) * sizes[r].ell / cells_in_ell)
      warnings.push_back(fmt::format(
          "region \"{}\": cells are up to {:.3g} m thick, ell is {:.3g} m: a crack in the thick ones would not "
          "be resolved (at most ell/{:g})",
          mesh.region_names[r], sizes[r].thickness, sizes[r].ell, cells_in_ell));
    const RegionModel& region = model.regions[r];
    if (!region.damageable || !region.strength.is_chosen()) continue;
    if (const double largest = largest_length(region.strength.data()); region.ell > largest)
      warnings.push_back(fmt::format(
          "region \"{}\": ell is {:.3g} m; a model of strength needs less than 3 Gc/(16 W) = {:.3g} m, W being the "
          "energy density at the tensile strength",
          mesh.region_names[r], region.ell, largest));
  }
  for (const Band& band : bands) {
    const auto r = as_size(mesh.region_index(band.region));
    const RegionModel& region = model.regions[r];
    if (region.damageable && sizes[r].width > widest_in_ell * sizes[r].mean_ell)
      warnings.push_back(fmt::format(
          "region \"{}\": cells are {:.3g} m wide along the band in the mean, ell is {:.3g} m: the front of a "
          "crack that runs along it would not be resolved (at most ell)",
          band.region, sizes[r].width / sizes[r].n_cells, sizes[r].mean_ell / sizes[r].n_cells));
    const double half = std::min(model.crack->support, long_tail) * region.ell;
    if (region.damageable && band.width < 2.0 * half)
      warnings.push_back(
          fmt::format("region \"{}\" is {:.3g} m wide: the profile of a crack in it, {:.3g} m with this ell, reaches "
                      "beyond it",
                      band.region, band.width, 2.0 * half));
  }
  return warnings;
}

std::vector<std::string> direction_remarks(const Mesh& mesh, const FractureModel& model) {
  constexpr Index in_a_plane = 4;  // interior faces of a hexahedron with neighbours in two directions
  constexpr double cost = 0.21;    // of an oblique crack over one along a row, times c0 ell/h: AT2, AT1 and Wu
  struct Hexahedra {
    Index n = 0, n_cells = 0;
    double thickness = 1.0;  // the least, over ell
  };
  std::vector<Hexahedra> regions(model.regions.size());
  const auto is_interior = [&](Index f) { return mesh.is_interior(f); };
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Hexahedra& region = regions[as_size(mesh.region[c])];
    ++region.n_cells;
    if (!model.in_cell(mesh, c).damageable || mesh.shape[c] != CellShape::hexahedron) continue;
    if (std::ranges::count_if(mesh.faces_of_cell(c), is_interior) < in_a_plane) continue;
    ++region.n;
    region.thickness = std::min(region.thickness, thickness(mesh, c) / model.in_cell(mesh, c).ell);
  }
  std::vector<std::string> remarks;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (2 * regions[r].n < regions[r].n_cells || regions[r].n == 0) continue;
    remarks.push_back(fmt::format(
        "region \"{}\": cracks oblique to the rows of hexahedra cost up to {:.1f} % more than along them where cells "
        "are "
        "smallest (ell/h = {:.2g}), and growing ones keep to the rows: at ell/h = 3 one that ought to turn by 11, 25, "
        "35 "
        "degrees turns by 0, 8, 29. Where directions are not known beforehand, use smaller cells, prisms or tetrahedra "
        "([mesh])",
        mesh.region_names[r], 100.0 * cost / model.crack->c0 * regions[r].thickness, 1.0 / regions[r].thickness));
  }
  return remarks;
}

}  // namespace pfdm
