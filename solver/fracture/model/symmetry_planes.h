#pragma once
// Cracks in planes of symmetry. Such a crack breaks the row of cells beside the plane, and its mirror image another
// one: two rows, where a crack elsewhere breaks one. With fluxes between the cells' centres that costs h/(2 ell) (AT2)
// or 3 h/(8 ell) (AT1) too much, 12 and 9 % at h = ell/4.

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

namespace pfdm {

/// Vector [m] of each cell from its centre to the point that its damage stands for; empty if that is the centre for
/// all. For a cell beside a plane of symmetry, or beside one that is held along its normal alone, the point is on the
/// plane, where the damage of a crack in it is largest. Distances to its neighbours begin there. A straight crack then
/// costs 0.6 (h/ell)^2 (AT2) or 0.3 (h/ell)^2 (AT1) too much, and damage without a kink at the plane changes by O(h^2).
/// Cells without a face opposite to the plane, as tetrahedra, keep their centre: of them a row is a third as thick. So
/// do rows thicker than ell, in which no crack in the plane is resolved.
CellField<Vector> damage_points(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
