#pragma once
// From cells as lists of points to faces: every cell's own faces, and which of them are the same face.

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace pfdm {

/// The faces of all cells, cell by cell, each counter-clockwise when seen from outside its cell.
struct HalfFaces {
  std::vector<Index> cell;        ///< the cell of each half-face
  std::vector<Index> offsets{0};  ///< size() + 1 entries into points
  std::vector<Index> points;

  Index size() const { return static_cast<Index>(cell.size()); }
  std::span<const Index> points_of(Index half_face) const {
    const Index first = offsets[half_face];
    return {points.data() + first, static_cast<std::size_t>(offsets[half_face + 1] - first)};
  }
};

/// One face of the mesh: one half-face, or two where two cells meet.
struct FacePair {
  Index first;
  Index second;  ///< -1 on the boundary
};

/// Throws InputError if a cell has the wrong number of points for its shape, or a polyhedron's faces do not close.
HalfFaces half_faces(const CellSoup& soup);

/// Half-faces on the same points are one face. Throws InputError if more than two are.
std::vector<FacePair> pair_half_faces(const HalfFaces& halves, Index n_points);

/// Volume [m^3] of a cell of any shape but a polyhedron; negative if its points are in mirrored order.
double signed_cell_volume(const std::vector<Vector>& points, CellShape shape, std::span<const Index> cell);

/// How many points a cell of this shape has; 0 for polyhedra, which may have any number.
Index points_per_cell(CellShape shape);

}  // namespace pfdm
