#pragma once
// Sizes of cells that decide whether a crack and its front are resolved, beside the lengths that they have to resolve.

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

#include <string>
#include <vector>

namespace pfdm {

inline constexpr double cells_in_ell = 2.0;  ///< at least: the discrete toughness is then within 3 % (AT2) of Gc
/// Along a band: with edges of ell the force after a bead's debonding is within 1 % of that of finer ones. Layers
/// around a sphere widen outwards.
inline constexpr double widest_in_ell = 1.25;

/// Extent of a cell across its largest face [m]: a prism layer's thickness, a brick's shortest edge, a third of a
/// tetrahedron's height; of a rounder polyhedron twice the distance of that face.
double cell_thickness(const Mesh& mesh, Index cell);

/// Whether a cell of this thickness does not resolve a crack.
bool is_too_thick(double thickness, double ell);

/// Sizes of the cells of a region that can be damaged.
struct CellSizes {
  double thickness = 0.0, ell = 1.0;  ///< of the cell that is the thickest for its ell [m]
  double width = 0.0, front = 0.0;    ///< sums of widths and of lengths of a crack's front that they resolve [m]
  double shortest = 0.0;              ///< edge in the plane of the cell where that is the shortest for ell [m]
  Index n_cells = 0, n_too_thick = 0;
  Index n_fine = 0;      ///< no wider than the front's length
  Index n_too_long = 0;  ///< in a plane, with edges longer than ell
};
std::vector<CellSizes> sizes_by_region(const Mesh& mesh, const FractureModel& model);

/// A length [m] with three digits: "12.5 um".
std::string length_text(double x);

}  // namespace pfdm
