#pragma once
// Slender bodies in which there are prisms, tetrahedra, pyramids or polyhedra: the layers of cells across them, and how
// wrongly gradients of one ring (of tetrahedra: two) bend them.
//
// Layers are found along straight lines inwards from free faces to the free face opposite. The size of a cell along a
// unit vector e is its mean chord 2 V/sum |S_f.e|, V being its volume and S_f the area vectors of its faces.

#include "mesh/mesh.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/body/unknowns.h"

#include <array>
#include <vector>

namespace pfdm {

enum class SlenderCells {
  prisms_across,  ///< their triangles lie on the surfaces
  prisms_within,  ///< their triangles lie in the plane of bending, as in plane meshes
  prisms_along,   ///< their triangles lie across the length
  tetrahedra,     ///< or pyramids
  polyhedra,
};

/// Of a cell that is no hexahedron; pyramids count as tetrahedra.
SlenderCells slender_cells(const Mesh& mesh, Index cell, const Vector& across, const Vector& along);
/// Sizes over mean chords, across and along: of the box that a pair of prisms or six tetrahedra fill.
std::array<double, 2> boxes_of(SlenderCells cells);

/// Layers across a body at a cell on its surface, in a direction in which it is at least three times as long as thick.
struct SlenderLayers {
  Index cell = 0;
  SlenderCells of = SlenderCells::tetrahedra;  ///< cells there, hexahedra apart
  Vector along = Vector::Zero();
  std::vector<Index> through;  ///< cells on the line across
  /// Layers and their length are those of the boxes that two prisms or six tetrahedra fill.
  BendingLayers layers;

  /// Bending stiffness with gradients of one ring (of tetrahedra: two) over the exact one, less 1. Measured with
  /// cantilevers of regular cells (bending.md): within a third, of polyhedra and two layers within a factor of two.
  double error(double nu) const;
  /// Of prisms that fit cubics in plane meshes, too little: 0.5 lone length/thickness, of materials of one box across.
  double lack_of_cubics() const;
};

/// At each free face from which the line across meets a cell that is no hexahedron, for the direction with the longest
/// cells. None in boxes that follow a mean strain or about an axis.
std::vector<SlenderLayers> slender_layers(const Mesh& mesh, const Unknowns& unknowns);

/// Whether a tenth of the free faces or more have such layers.
bool is_slender_body(const Mesh& mesh, const Unknowns& unknowns);

/// Per cell of a plane mesh the direction in which its layers are long, where prisms and hexahedra among them would
/// bend with an error of more than half a per cent; else zero. In space zero.
CellField<Vector> bending_prisms(const Mesh& mesh, const Unknowns& unknowns);

/// The size of a cell along a unit vector [m].
double mean_chord(const Mesh& mesh, Index cell, const Vector& e);

}  // namespace pfdm
