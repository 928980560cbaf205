#pragma once
// Spins of cells that the unknowns do not see. Displacements are compared at the centres of faces, and a cell of a
// column one cell wide, or one alone, can turn about the line of these centres without moving any of them. The cells
// beside it in the column and the planes of its faces, which turn with it in the body, then hold it by the gradients of
// displacement. Between cells that is a beam's resistance to torsion. At a face along which a displacement is
// prescribed it is that displacement's slope. Where the spin is free of load they do nothing.

#include "mesh/mesh.h"

#include <vector>

namespace pfdm {

struct Unknowns;

/// One of them: of_cell : (G of the cell - G of the one beyond it) is held, or, where there is none, is the slope of a
/// prescribed displacement; G = du_i/dx_j.
struct SpinHold {
  Index cell = 0, beyond = -1;
  Tensor of_cell = Tensor::Zero();  ///< [-]
  double stiffness = 0.0;           ///< over the shear modulus [m^3]
  Vector lever = Vector::Zero();    ///< what it is, times a rotation of the cell that the unknowns do not see [-]
  Index face = 0;                   ///< on which the displacement is prescribed,
  Vector held = Vector::Zero();     ///< in this direction; the slope is
  Vector along = Vector::Zero();    ///< in this one
};

/// Holds of all cells but tetrahedra, whose gradients reach further.
std::vector<SpinHold> spin_holds(const Mesh& mesh, const Unknowns& unknowns);

}  // namespace pfdm
