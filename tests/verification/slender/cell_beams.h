#pragma once
// Beams along x, y across and z over their width, of boxes that are cut into prisms or tetrahedra.

#include "mesh/mesh.h"

#include <array>
#include <vector>

namespace pfdm::verification {

enum class BoxCut {
  prisms_across,        ///< triangles on the surfaces y
  prisms_within,        ///< triangles in the planes z, as in plane meshes
  prisms_along,         ///< triangles in the planes x
  six_tetrahedra,       ///< about one diagonal
  polyhedra_of_prisms,  ///< dual to prisms_within
  polyhedra,            ///< dual to six_tetrahedra
};

struct CellBeam {
  BoxCut cut = BoxCut::prisms_within;
  std::array<Index, 3> boxes{1, 1, 1};
  Vector size = Vector::Ones();  ///< [m]
  bool alternates = false;       ///< diagonals of prisms turn from box to box
  std::vector<double> levels{};  ///< of the boxes across, from 0 to 1, one more than boxes; empty: even
  double noise = 0.0;            ///< points within the beam move along x and y by up to half of this part of a box
};

/// Of one region; patches as of a box.
Mesh make_cell_beam(const CellBeam& beam);

}  // namespace pfdm::verification
