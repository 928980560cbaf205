#pragma once
// What an unstructured VTK file holds, as plain data (VTK).

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/fields.h"

namespace pfdm {

struct VtkFile {
  std::vector<Vector> points;  ///< in the file's unit
  std::vector<int> cell_type;  ///< VTK's numbers
  std::vector<Index> cell_offsets{0};
  std::vector<Index> cell_points;
  /// For each polyhedron in turn [n_faces, n_points, p..., n_points, p...].
  std::vector<std::vector<Index>> polyhedron_faces;
  /// The cell arrays of one component whose values are whole numbers.
  std::map<std::string, std::vector<Index>> integer_arrays;
};

/// Reads a .vtu or a legacy .vtk file. Throws InputError naming the path and the reason; VTK itself stays silent.
VtkFile read_vtk_file(const std::filesystem::path& path);

/// For each point the number of the first one within the tolerance (same unit), counted without the others; the points
/// that are left take their place.
std::vector<Index> merge_points(std::vector<Vector>& points, double tolerance);

}  // namespace pfdm
