#pragma once
// How the points of a mesh have moved, for a look at it ("Warp By Vector"): the sound cells tell. Where a crack parts
// those around a point, the point has a copy for each side, so that the crack opens.

#include "mesh/mesh.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/body/boundary_condition.h"

#include <vector>

namespace pfdm {

/// Damage above which a cell no longer ties its neighbours together.
constexpr double broken_damage = 0.95;

/// At each point the mean of u_c + G_c (x - x_c) over the cells around it with d <= 0.95, weighted by (1 - d)^2 and the
/// inverse of the distance: exact where the displacement is linear, also with a kink between materials. Where sound
/// cells around a point are joined by no face between sound ones at that point, other than a cohesive one, it is split;
/// a broken cell goes with a side that it has a face with. Where one of the cells has d > 0.5 the mean stays within the
/// displacements of their centres; where all are broken, they all count. On patches the prescribed components are those
/// of the conditions at the load parameter `load`, and none is normal to a plane of symmetry; the first condition wins
/// where two disagree. Needs displacement, damage and gradient.
SplitPoints point_displacement(const Mesh& mesh, const std::vector<BoundaryCondition>& boundary,
                               const OutputFields& output, double load);

}  // namespace pfdm
