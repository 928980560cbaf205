#pragma once
// What a mesh file holds, as plain data, whatever its format.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "mesh/fields.h"

namespace pfdm {

struct MeshFile {
  std::vector<Vector> points;  ///< in the file's unit
  std::vector<int> cell_type;  ///< VTK's numbers; also of surface elements, lines and vertices
  std::vector<Index> cell_offsets{0};
  std::vector<Index> cell_points;
  /// For each polyhedron in turn [n_faces, n_points, p..., n_points, p...].
  std::vector<std::vector<Index>> polyhedron_faces;
  std::vector<std::int64_t> cell_number;  ///< by which the file calls its cells; empty: from 0 on
  /// The cell arrays of one component whose values are whole numbers.
  std::map<std::string, std::vector<Index>> integer_arrays;
  /// Names that the file has for the numbers of regions, of face sets and of lines.
  std::map<Index, std::string> region_names, patch_names, line_names;
  bool has_groups = false;                 ///< its numbers are Gmsh's physical groups, and 0 none
  bool has_volumes_without_cells = false;  ///< it names volumes, as a geometry, and has no cells of any

  /// Up to here VTK's numbers are vertices, lines, triangles, strips, polygons, pixels and quadrilaterals.
  static constexpr int last_flat_type = 9;
  Index n_cells() const { return count_of(cell_type); }
  /// What the file calls a cell.
  std::int64_t number_of(Index cell) const { return cell_number.empty() ? cell : cell_number[cell]; }
  /// Whether it is a triangle, a quadrilateral or a polygon.
  bool is_face(Index cell) const {
    const int type = cell_type[cell];
    return type == 5 || (type >= 7 && type <= last_flat_type);
  }
};

/// The faces of a prism as of a polyhedron, [n_faces, n_points, p ...]. `points`: those around its base, then those of
/// its top in the same order.
std::vector<Index> faces_of_prism(std::span<const Index> points);

}  // namespace pfdm
