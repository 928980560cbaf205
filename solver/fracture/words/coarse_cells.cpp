#include "solver/fracture/words/coarse_cells.h"

#include "physics/quantity_text.h"
#include "solver/fracture/words/cell_sizes.h"
#include "solver/momentum/bending/bending_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double largest_drop = 0.6;  // of damage to the next cell: profiles are no steeper than 1/ell

std::string place_text(const Vector& x) {
  return point_text(x.unaryExpr([](double v) { return std::abs(v) < 1e-15 ? 0.0 : v; }));
}

}  // namespace

CoarseCells::CoarseCells(const Mesh& mesh, const FractureModel& model)
    : mesh_(mesh), model_(model), told_(model.regions.size(), false) {
  const std::vector<CellSizes> sizes = sizes_by_region(mesh, model);
  for (std::size_t r = 0; r < sizes.size(); ++r) told_[r] = sizes[r].n_too_thick == sizes[r].n_cells;  // before the run
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    if (region.damageable && is_too_thick(cell_thickness(mesh, c), region.ell)) cells_.push_back(c);
  }
}

std::vector<std::string> CoarseCells::look(const CellField<double>& damage) {
  constexpr double cracked = 0.5;
  std::vector<std::string> warnings;
  for (const Index c : cells_) {
    const std::size_t r = mesh_.region[c];
    if (told_[r] || !(damage[c] > cracked)) continue;
    told_[r] = true;
    warnings.push_back(
        fmt::format("region \"{}\": a crack has entered cells that do not resolve it, {} thick at {} with "
                    "ell = {} (at most ell/{:g}): smaller cells there in [mesh], or a larger length in [fracture]",
                    mesh_.region_names[r], length_text(cell_thickness(mesh_, c)), place_text(mesh_.cell_centre[c]),
                    length_text(model_.in_cell(mesh_, c).ell), cells_in_ell));
  }
  look_at_neighbours(damage, warnings);
  return warnings;
}

// Whether the cells beyond this face of a hexahedron, away from which damage falls, make a crack of one or two cells,
// in contrast to the broken side of a crack's front. A boundary is taken for a mirror.
bool CoarseCells::is_narrow(Index cell, Index face, const CellField<double>& damage) const {
  for (int cells = 0; cells < 2; ++cells) {
    face = opposite_face(mesh_, cell, face);
    if (face < 0) return false;
    if (!mesh_.is_interior(face)) return true;
    const Index next = mesh_.across(face, cell);
    if (damage[cell] - damage[next] > largest_drop) return true;
    cell = next;
  }
  return false;
}

void CoarseCells::look_at_neighbours(const CellField<double>& damage, std::vector<std::string>& warnings) {
  const auto drop_at = [&](Index f) { return std::abs(damage[mesh_.owner[f]] - damage[mesh_.neighbour[f]]); };
  const auto spacing = [&](Index f) {
    return (mesh_.cell_centre[mesh_.owner[f]] - mesh_.cell_centre[mesh_.neighbour[f]]).norm();
  };
  // Steps of a crack from row to row are steeper across the rows.
  const auto is_steepest = [&](Index f, Index cell) {
    return std::ranges::none_of(mesh_.faces_of_cell(cell), [&](Index g) {
      return mesh_.is_interior(g) && drop_at(g) * spacing(f) > 1.5 * drop_at(f) * spacing(g);
    });
  };
  for (Index f = 0; f < mesh_.n_interior_faces(); ++f) {
    if (!(drop_at(f) > largest_drop)) continue;
    const Index one = mesh_.owner[f], other = mesh_.neighbour[f];
    const RegionModel &here = model_.in_cell(mesh_, one), &there = model_.in_cell(mesh_, other);
    const double ell = std::min(here.ell, there.ell);
    const Index broken = damage[one] > damage[other] ? one : other;
    const std::size_t r = mesh_.region[broken];
    if (told_[r] || !here.damageable || !there.damageable || !(spacing(f) > largest_drop * ell)) continue;
    if (!is_steepest(f, one) || !is_steepest(f, other)) continue;
    if (!(spacing(f) > widest_in_ell * ell) && !is_narrow(broken, f, damage)) continue;
    told_[r] = true;
    warnings.push_back(
        fmt::format("region \"{}\": the damage changes by {:.2f} from a cell to the next, {} apart at {} with ell = "
                    "{}: the crack is not resolved (at most ell/{:g}: smaller cells there in "
                    "[mesh], or a larger length in [fracture])",
                    mesh_.region_names[r], drop_at(f), length_text(spacing(f)), place_text(mesh_.face_centre[f]),
                    length_text(ell), cells_in_ell));
  }
}

}  // namespace pfdm
