#pragma once
// Memory of the gaps at the faces of viscoelastic cells at finite strain. A gap is the part of a face's displacement
// that the gradient of the cell does not have, y = u_f - u_c - H d; turned back by the rotation R of the cell and over
// the distance of the face it is a strain z, borne by the branches as any other
// (solver/fracture/gaps/relaxing_gaps.h). What they have left of earlier gaps is an initial traction of the side
// beside a y,
//
//   x + (m (c.x) + b) c,  x = share R sum mu_i left_i,  m = lambda/mu of the branches + phi(J)
//
// (finite_tractions.h), outwards from the cell; m is capped in polyhedra as the stiffness of their jumps is. b is what
// bulk branches have left of earlier c.y, over the distance of the face, times their moduli.

#include "solver/momentum/body/cell_mechanics.h"
#include "solver/momentum/faces/face_skeleton.h"
#include "solver/momentum/finite_strain/finite_states.h"

#include <vector>

namespace pfdm {

class FiniteMemory {
 public:
  explicit FiniteMemory(const FaceSkeleton& skeleton) : skeleton_(skeleton) {}

  /// What is left of earlier gaps, sums of mu_i and of K_j times it [Pa], by Mesh::cell_faces; empty: no cell relaxes.
  void set(const std::vector<GapStress>& gaps);
  /// Turns it with the cells, once the states are linearised.
  void turn(const FiniteStates& states);

  bool any() const { return !left_.empty(); }
  /// R of a cell that relaxes.
  const Tensor& rotation(Index cell) const { return rotation_[cell]; }
  /// x [Pa] on side number `turn`, in links along their normal from P to N.
  const Vector& left(std::size_t turn) const { return turned_[turn]; }
  /// b [Pa], of a cell in which nothing is capped.
  double bulk_left(std::size_t turn) const { return bulk_[turn]; }
  /// visit(place in Mesh::cell_faces, face, number of the side) of each face of a cell that bears a force.
  template <class Visit>
  void visit_sides(Index cell, const Visit& visit) const {
    const FaceSkeleton::SignedForce* next = skeleton_.forces_of(cell).data();
    const std::size_t first = skeleton_.mesh.cell_face_offsets[cell];
    const auto faces = skeleton_.mesh.faces_of_cell(cell);
    for (std::size_t k = 0; k < faces.size(); ++k)
      if (skeleton_.force_of_face[faces[k]] >= 0) visit(first + k, faces[k], skeleton_.turn_at(*next++));
  }
  /// -1 on the side of a link's N, whose normal leads inwards.
  double outwards(std::size_t turn) const {
    return !skeleton_.is_side(turn) && turn == FaceSkeleton::turn_N(turn / 2) ? -1.0 : 1.0;
  }

 private:
  const FaceSkeleton& skeleton_;
  std::vector<Vector> left_, turned_;     // by turn; empty if no cell relaxes
  std::vector<double> bulk_left_, bulk_;  // likewise
  CellField<Tensor> rotation_;
};

}  // namespace pfdm
