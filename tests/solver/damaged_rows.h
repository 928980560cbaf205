#pragma once
// Rows of cells with one toughness and length, for the damage equation.

#include "solver/fracture/damage/damage_equation.h"
#include "tests/solver/solver_checks.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {

inline constexpr double Gc = 10.0, ell = 20e-6;
inline const double unit = Gc / ell;  // of energy densities [J/m^3]

inline FractureModel model_of(const Mesh& mesh, std::string_view law) {
  FractureModel model;
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
    model.regions.push_back({.elasticity = {}, .Gc = Gc, .ell = ell});
  model.crack = &crack_geometry(law);
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  return model;
}

inline CellField<double> uniform(const Mesh& mesh, double value) { return CellField<double>(mesh.n_cells(), value); }

/// A row of cells of width h along x, with regions cut out of it.
inline Mesh row(Index n, double h, std::vector<SubRegion> regions = {}) {
  return box(n, 1, 1, {n * h, h, h}, 1.0, std::move(regions));
}

inline SubRegion from_to(const std::string& name, double from, double to) {
  return {.name = name, .lower = {from, -1.0, -1.0}, .upper = {to, 1.0, 1.0}};
}

/// Cells along x.
inline std::vector<Index> in_order_of_x(const Mesh& mesh) {
  std::vector<Index> cells(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) cells[c] = c;
  std::sort(cells.begin(), cells.end(),
            [&](Index a, Index b) { return mesh.cell_centre[a][0] < mesh.cell_centre[b][0]; });
  return cells;
}

}  // namespace pfdm
