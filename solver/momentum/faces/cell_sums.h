#pragma once
// Sums over the faces of a cell, from which its strain, stress and energy follow. The strain is that of the face
// displacements at which the two sides of each face agree (Green-Gauss). It is exact in a laminate however broken a
// layer is. The least-squares gradient, which reaches over the layer, is wrong by factors there. With the tractions it
// closes the energy account: sum over cells of 1/2 sum A t.(u_f - u_c) is half the work of the boundary forces, because
// t and u_f are one on each face and the forces on a cell cancel.

#include "solver/momentum/faces/face_tractions.h"

namespace pfdm {

/// Moves of the faces of cells by the displacements u of a sweep.
struct FaceMoves {
  const FaceSkeleton& skeleton;
  const Sweep& sweep;
  const std::vector<Vector>& u;
  const FaceField<Vector>& u_face;  ///< of FaceTractions::face_displacements() [m]

  /// Displacement [m] of a cell's face on the cell's side. Faces of plane patches carry no unknown: they move with
  /// their cell, within the plane. Those of a sector move with its gradient, in themselves.
  Vector seen_from(Index cell, Index face) const;

 private:
  Vector moved_with(Index cell, Index face) const;
};

/// Sums over the faces of a cell, before the closure of its faces.
struct CellSums {
  Tensor gradient = Tensor::Zero();  ///< sum (u_f - u_c) (x) S [m^3]
  Tensor moment = Tensor::Zero();    ///< sum A t (x) (x_f - x_c) [J]
  double work = 0.0;                 ///< 1/2 sum A t.(u_f - u_c) [J]
};

/// Calls also(force, area, arm, move) of each face that bears forces: which one, null on the sector's own; the area
/// vector outwards, x_f - x_c and u_f - u_c.
template <class Also>
CellSums sum_over_faces(Index cell, const FaceMoves& moves, const Also& also) {
  const FaceSkeleton& skeleton = moves.skeleton;
  const Mesh& mesh = skeleton.mesh;
  CellSums sums;
  const FaceSkeleton::SignedForce* next = skeleton.forces_of(cell).data();
  for (const Index f : mesh.faces_of_cell(cell)) {
    const Vector area = mesh.outward_area(f, cell);
    const Vector move = moves.seen_from(cell, f) - moves.u[cell];
    sums.gradient += move * area.transpose();
    const bool has_node_or_link = skeleton.force_of_face[f] >= 0;
    if (!has_node_or_link && !skeleton.unknowns.is_axisymmetric()) continue;
    const FaceSkeleton::SignedForce* on = has_node_or_link ? next++ : nullptr;
    const Vector force = on != nullptr ? (on->sign * moves.sweep.force[on->force]).eval()
                                       : (moves.sweep.sector_stress[cell] * area).eval();
    const Vector arm = mesh.face_centre[f] - mesh.cell_centre[cell];
    sums.moment += force * arm.transpose();
    sums.work += 0.5 * force.dot(move);
    also(on, area, arm, move);
  }
  return sums;
}

}  // namespace pfdm
