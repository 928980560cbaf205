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
};

/// The faces of a prism as of a polyhedron, [n_faces, n_points, p ...]. `points`: those around its base, then those of
/// its top in the same order.
std::vector<Index> faces_of_prism(std::span<const Index> points);

}  // namespace pfdm
