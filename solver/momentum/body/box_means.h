#pragma once
// Means of stress and strain over a box, from the forces and displacements of its sides,
//
//   <sigma> = (1/V) sum sym(f (x) x),  <eps> = (1/V) sum sym(u (x) S),
//
// f the forces on the faces and S their area vectors: exact where forces and displacements are consistent, whatever is
// inside. Voids and opened cracks count as parts of the box.

#include "solver/momentum/body/unknowns.h"

namespace pfdm {

struct BoxMeans {
  Tensor stress = Tensor::Zero();  ///< [Pa]
  Tensor strain = Tensor::Zero();
};

/// `sides`: the faces of all six; `boundary_force` [N] of each boundary face, in the mesh's face order; `u` as solved
/// for [m].
BoxMeans box_means(const Mesh& mesh, const Unknowns& unknowns, const std::vector<Index>& sides,
                   const std::vector<Vector>& boundary_force, const std::vector<Vector>& u);

/// The faces of the sides of a box that moves so.
std::vector<Index> faces_of_sides(const BoxMotion& motion);

}  // namespace pfdm
