#pragma once
// What an unstructured VTK file holds, as plain data (VTK).

#include <filesystem>
#include <vector>

#include "mesh/files/mesh_file.h"

namespace pfdm {

/// Reads a .vtu or a legacy .vtk file. Throws InputError naming the path and the reason; VTK itself stays silent.
MeshFile read_vtk_file(const std::filesystem::path& path);

/// For each point the number of the first one within the tolerance (same unit), counted without the others; the points
/// that are left take their place.
std::vector<Index> merge_points(std::vector<Vector>& points, double tolerance);

}  // namespace pfdm
