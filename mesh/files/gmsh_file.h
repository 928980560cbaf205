#pragma once
// Meshes of Gmsh: .msh files of the formats 4.1 and 2.2, text or binary.

#include <filesystem>

#include "mesh/files/mesh_file.h"

namespace pfdm {

/// The physical groups are the cell array "gmsh:physical" (0: in none), with the names of volumes, surfaces and
/// lines as those of regions, patches and lines; what is in no volume group is "body". Throws
/// InputError naming the path, the place and the reason: another format, elements of second or higher order, a mesh in
/// partitions, an element in two groups of its dimension.
MeshFile read_gmsh_file(const std::filesystem::path& path);

}  // namespace pfdm
