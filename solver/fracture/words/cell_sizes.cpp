#include "solver/fracture/words/cell_sizes.h"

#include "physics/quantity_text.h"
#include "solver/momentum/bending/bending_layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double rounding = 1e-9;  // of sizes that come from coordinates

Index largest_face(const Mesh& mesh, Index cell) {
  return std::ranges::max(mesh.faces_of_cell(cell), {}, [&](Index f) { return mesh.face_area[f].norm(); });
}

// Longest edge of a hexahedron in the plane of a mesh one cell thick, plane or axisymmetric; else 0.
double width_in_plane(const Mesh& mesh, Index cell) {
  if (mesh.shape[cell] != CellShape::hexahedron) return 0.0;
  double width = 0.0;
  bool is_flat = false;
  for (const Index f : mesh.faces_of_cell(cell)) {
    const Index other = opposite_face(mesh, cell, f);
    if (other < 0) return 0.0;
    if (mesh.is_interior(f) || mesh.is_interior(other))
      width = std::max(width, 2.0 * mesh.cell_volume[cell] / (mesh.face_area[f].norm() + mesh.face_area[other].norm()));
    else
      is_flat = true;
  }
  return is_flat ? width : 0.0;
}

// Edge of a cell along its largest face, if that is a regular triangle or a square.
double width_of_largest_face(const Mesh& mesh, Index cell) {
  const Index largest = largest_face(mesh, cell);
  const bool is_triangle = mesh.points_of_face(largest).size() == 3;
  return std::sqrt(mesh.face_area[largest].norm() * (is_triangle ? 4.0 / std::numbers::sqrt3 : 1.0));
}

// Length that the cells along a band have to resolve [m]: ell, or with softening of a given strength the process zone
// E' Gc/ft^2 at a crack's front if that is longer, E' = E/(1 - nu^2). Gc and ft follow from g'(0) = -4 E Gc/(c0 ell
// ft^2).
double front_length(const FractureModel& model, const RegionModel& region) {
  const Degradation& g = model.degradation_of(region);
  if (!g.is_chosen() || !g.law().needs_strength) return region.ell;
  const double nu = region.elasticity.poisson_ratio(), softening = -0.25 * model.crack->c0 * g.g_prime(0.0);
  return region.ell * std::max(1.0, softening / (1.0 - nu * nu));
}

}  // namespace

double cell_thickness(const Mesh& mesh, Index cell) {
  const Index largest = largest_face(mesh, cell);
  const Vector &area = mesh.face_area[largest], to_face = mesh.face_centre[largest] - mesh.cell_centre[cell];
  return std::min(mesh.cell_volume[cell], 2.0 * std::abs(to_face.dot(area))) / area.norm();
}

bool is_too_thick(double h, double ell) { return h > (1.0 + rounding) * ell / cells_in_ell; }

std::vector<CellSizes> sizes_by_region(const Mesh& mesh, const FractureModel& model) {
  std::vector<CellSizes> sizes(model.regions.size());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (!region.damageable) continue;
    CellSizes& of_region = sizes[mesh.region[c]];
    if (const double h = cell_thickness(mesh, c); h / region.ell > of_region.thickness / of_region.ell)
      of_region.thickness = h, of_region.ell = region.ell;
    of_region.n_too_thick += is_too_thick(cell_thickness(mesh, c), region.ell) ? 1 : 0;
    const double in_plane = width_in_plane(mesh, c);
    if (in_plane > (1.0 + rounding) * region.ell) {
      of_region.shortest = of_region.n_too_long == 0 ? in_plane : std::min(of_region.shortest, in_plane);
      ++of_region.n_too_long;
    }
    const double along = in_plane > 0.0 ? in_plane : width_of_largest_face(mesh, c),
                 front = front_length(model, region);
    of_region.width += along;
    of_region.front += front;
    of_region.n_fine += along <= (1.0 + rounding) * front ? 1 : 0;
    ++of_region.n_cells;
  }
  return sizes;
}

std::string length_text(double x) { return quantity_text(x, "m", 3); }

}  // namespace pfdm
