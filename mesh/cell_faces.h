#pragma once
// From cells as lists of points to faces: every cell's own faces, and which of them are the same face.

#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace pfdm {

/// The faces of all cells, cell by cell, each counter-clockwise when seen from outside its cell.
struct HalfFaces {
  std::vector<Index> cell;        ///< the cell of each half-face
  std::vector<Index> offsets{0};  ///< size() + 1 entries into points
  std::vector<Index> points;

  void add(Index of_cell, std::span<const Index> of_face) {
    cell.push_back(of_cell);
    points.insert(points.end(), of_face.begin(), of_face.end());
    offsets.push_back(count_of(points));
  }
  Index size() const { return count_of(cell); }
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

/// All faces of a mesh and the patches of those on its boundary.
struct FaceTable {
  HalfFaces halves;
  std::vector<FacePair> pairs;
  std::vector<Index> patch;  ///< of each pair: entry into patch_names, -1 for interior faces
  std::vector<std::string> patch_names;
  std::vector<Index> apex;  ///< of each pair: point that the face's fan of triangles is about; empty: means of points
};

/// Throws InputError if a cell has the wrong number of points for its shape, or a polyhedron's faces do not close.
HalfFaces half_faces(const CellSoup& soup);

/// Half-faces on the same points are one face. Throws InputError if more than two are.
std::vector<FacePair> pair_half_faces(const HalfFaces& halves, Index n_points);

/// Fills cell_face_offsets and cell_faces of a mesh whose faces are there.
void list_faces_of_cells(Mesh& mesh);

/// Volume [m^3] of a cell of any shape but a polyhedron; negative if its points are in mirrored order.
double signed_cell_volume(const std::vector<Vector>& points, CellShape shape, std::span<const Index> cell);

/// Turns a cell with its points in mirrored order into itself in right order; of any shape but a polyhedron.
void mirror_cell(CellShape shape, std::vector<Index>& points);

/// How many points a cell of this shape has; 0 for polyhedra, which may have any number.
Index points_per_cell(CellShape shape);

}  // namespace pfdm
