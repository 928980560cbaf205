#pragma once
// Loads on a body from outside at a load parameter t: prescribed displacements, tractions, pressures, body forces,
// elastic foundations, and the motion of a box by a mean strain.

#include "solver/linear/block_matrix.h"
#include "solver/momentum/body/pressed_faces.h"
#include "solver/momentum/faces/face_skeleton.h"

#include <vector>

namespace pfdm {

class BoundaryLoads {
 public:
  explicit BoundaryLoads(const FaceSkeleton& skeleton);

  /// Writes the prescribed components of the boundary nodes at the load parameter t [m].
  void prescribe(double t, std::vector<Vector>& u) const;
  /// Forces of prescribed tractions, pressures and body forces [N], and of mean stresses on the free strains of a box;
  /// pressures on the areas of the last linearisation.
  std::vector<Vector> forces(double t) const;
  /// Displacement [m] that is prescribed at the place x of a boundary face; zero where none is.
  Vector prescribed_at(Index face, const Vector& x, double t) const;

  /// Pressures follow the body from now on (PressedFaces::linearise).
  void follow(double t, const std::vector<Vector>& u, const CellField<Tensor>& gradients, const CellField<double>& g) {
    pressed_faces_.linearise(t, u, gradients, g);
  }
  /// out += what the loads lose by displacements u with these gradients of the cells [N]: foundations, and pressures
  /// that follow the body.
  void add_response(const std::vector<Vector>& u, const CellField<Tensor>& gradients, std::vector<Vector>& out) const;
  /// matrix += the response, without that of pressures.
  void add_to(BlockTriplets& matrix) const;
  /// Energy in the foundations [J].
  double stored(const std::vector<Vector>& u) const;
  /// load += what following pressures lose by the displacements about which they are linearised [N].
  void add_initial_turn(std::vector<Vector>& load) const { pressed_faces_.add_initial_turn(load); }

 private:
  // A face on a foundation: area times K [N/m].
  struct Support {
    Index node;
    Tensor stiffness;
  };
  void add_tractions(double t, std::vector<Vector>& load) const;
  void move_box(double t, std::vector<Vector>& u) const;

  const FaceSkeleton& skeleton_;
  PressedFaces pressed_faces_;
  std::vector<Support> supports_;
};

}  // namespace pfdm
