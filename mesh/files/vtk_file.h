#pragma once
// What an unstructured VTK file holds, as plain data (VTK).

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/files/mesh_file.h"
#include "mesh/mesh.h"

namespace pfdm {

/// Reads a .vtu or a legacy .vtk file. Throws InputError naming the path and the reason; VTK itself stays silent.
MeshFile read_vtk_file(const std::filesystem::path& path);

/// Of VTK's cells of first order with a volume (its voxels are hexahedra); nothing for others.
std::optional<CellShape> shape_of(int vtk_type);

/// One array of a file, whatever it means.
struct FileArray {
  bool at_points = false;  ///< or in cells
  int n_components = 1;
  std::vector<double> values;  ///< [n_points or n_cells, n_components], row by row
};

/// Likewise, with the array of that name at points, or else in cells. Throws InputError also where there is none.
std::pair<MeshFile, FileArray> read_vtk_array(const std::filesystem::path& path, const std::string& array);

/// The same in this process, which VTK's readers may crash on a damaged file; an empty `array` stands for none, `noun`
/// for what messages call the file.
std::pair<MeshFile, FileArray> read_vtk_here(const std::filesystem::path& path, const std::string& array,
                                             std::string_view noun);

/// For each point the number of the first one within the tolerance (same unit), counted without the others; the points
/// that are left take their place.
std::vector<Index> merge_points(std::vector<Vector>& points, double tolerance);

}  // namespace pfdm
