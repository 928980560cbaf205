#pragma once
// A face-based polyhedral mesh: plain data, its geometry computed once. Every cell-centred loop needs
// only owner, neighbour and the face geometry; the cells' points are kept for output and quality.

#include "mesh/fields.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

enum class CellShape : std::uint8_t { tetrahedron, wedge, pyramid, hexahedron, polyhedron };

/// Faces [first_face, first_face + n_faces) of the boundary, under one name.
struct Patch {
  std::string name;
  Index first_face = 0;
  Index n_faces = 0;
};

/// Faces are ordered: interior faces first (by owner, then neighbour), then the boundary patch by patch.
/// owner < neighbour for every interior face; a face's normal points from owner to neighbour, or outwards.
struct Mesh {
  std::vector<Vector> points;       ///< [m]
  std::vector<Index> face_offsets;  ///< n_faces + 1 entries into face_points
  std::vector<Index> face_points;   ///< counter-clockwise when seen from outside the owner
  FaceField<Index> face_apex;       ///< point that a face's fan of triangles is about; empty: the mean of its points
  FaceField<Index> owner;           ///< n_faces entries
  FaceField<Index> neighbour;       ///< n_interior_faces entries
  std::vector<Patch> patches;       ///< in face order, together all boundary faces

  CellField<CellShape> shape;
  std::vector<Index> cell_offsets;  ///< n_cells + 1 entries into cell_points
  std::vector<Index> cell_points;   ///< in VTK's order of the shape; for polyhedra each point once
  CellField<Index> region;          ///< entries into region_names
  std::vector<std::string> region_names;

  std::vector<Index> cell_face_offsets;  ///< n_cells + 1 entries into cell_faces
  std::vector<Index> cell_faces;         ///< faces of each cell, in ascending order

  FaceField<Vector> face_centre;  ///< [m]
  FaceField<Vector> face_area;    ///< area vector [m^2], along the face's normal
  CellField<Vector> cell_centre;  ///< [m]
  CellField<double> cell_volume;  ///< [m^3]

  Index n_cells() const { return shape.size(); }
  Index n_faces() const { return owner.size(); }
  Index n_interior_faces() const { return neighbour.size(); }
  bool is_interior(Index face) const { return face < n_interior_faces(); }

  std::span<const Index> points_of_face(Index face) const { return slice(face_offsets, face_points, face); }
  std::span<const Index> points_of_cell(Index cell) const { return slice(cell_offsets, cell_points, cell); }
  std::span<const Index> faces_of_cell(Index cell) const { return slice(cell_face_offsets, cell_faces, cell); }

  /// The cell on the other side of an interior face.
  Index across(Index face, Index cell) const { return owner[face] == cell ? neighbour[face] : owner[face]; }
  /// 1 where a face's normal leads out of this cell, -1 where it leads into it.
  double outwards(Index face, Index cell) const { return owner[face] == cell ? 1.0 : -1.0; }
  /// Area vector of a face as this cell sees it, outwards [m^2].
  Vector outward_area(Index face, Index cell) const { return outwards(face, cell) * face_area[face]; }

  /// Throws InputError naming the patches there are.
  Index patch_index(const std::string& name) const;
  const Patch& patch(const std::string& name) const { return patches[patch_index(name)]; }
  /// Throws InputError naming the regions there are.
  Index region_index(const std::string& name) const;

 private:
  static std::span<const Index> slice(const std::vector<Index>& offsets, const std::vector<Index>& list, Index i) {
    const auto k = static_cast<std::size_t>(i);
    return {list.data() + offsets[k], static_cast<std::size_t>(offsets[k + 1] - offsets[k])};
  }
};

/// Cells as lists of points, before faces are known: what generators and readers make.
struct CellSoup {
  std::vector<Vector> points;  ///< [m]
  std::vector<CellShape> shape;
  std::vector<Index> cell_offsets{0};
  std::vector<Index> cell_points;  ///< in VTK's order of the shape
  std::vector<Index> region;
  std::vector<std::string> region_names;
  /// Faces of polyhedra: for the k-th polyhedron [n_faces, n_points, p..., n_points, p...], as in VTK.
  std::vector<std::vector<Index>> polyhedron_faces;

  void add_cell(CellShape shape, std::span<const Index> points, Index region);
};

/// Names boundary faces: the first rule that holds gives the patch; faces that no rule claims become "walls".
struct PatchRule {
  std::string name;
  /// centre [m] and unit outward normal of a boundary face, and the ids of its points in the soup.
  std::function<bool(const Vector& centre, const Vector& normal, std::span<const Index> points)> holds;
  bool required = true;  ///< otherwise a rule that holds for no face leaves no patch
};

/// Finds faces and neighbours, orders cells for locality (reverse Cuthill-McKee), names patches and computes
/// the geometry. Throws InputError if a face has more than two cells, the boundary does not close, a cell has
/// no positive volume, or a required rule holds for no face.
Mesh assemble_mesh(CellSoup soup, const std::vector<PatchRule>& rules);

struct FaceTable;  // mesh/cell_faces.h

/// The same where the faces and their patches are known already: `polyhedron_faces` of the soup is not read.
Mesh assemble_from_faces(CellSoup soup, const FaceTable& table);

}  // namespace pfdm
