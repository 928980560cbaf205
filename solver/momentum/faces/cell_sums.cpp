#include "solver/momentum/faces/cell_sums.h"

namespace pfdm {

Vector FaceMoves::seen_from(Index cell, Index face) const {
  if (const Index node = skeleton.unknowns.node_beside(skeleton.mesh, cell, face);
      node != skeleton.unknowns.node_of_face[face])
    return u[node];
  return skeleton.force_of_face[face] >= 0 ? u_face[face] : moved_with(cell, face);
}

Vector FaceMoves::moved_with(Index cell, Index face) const {
  const Mesh& mesh = skeleton.mesh;
  if (skeleton.unknowns.is_axisymmetric()) {
    const Vector along = mesh.face_area[face].normalized();
    const Vector moved = u[cell] + sweep.gradients[cell] * (mesh.face_centre[face] - mesh.cell_centre[cell]);
    return moved - along.dot(moved) * along;
  }
  const Vector& n = skeleton.unknowns.plane_normal;
  return u[cell] - n.dot(u[cell]) * n;
}

}  // namespace pfdm
