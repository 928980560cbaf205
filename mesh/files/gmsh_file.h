#pragma once
// Meshes of Gmsh: .msh files of the formats 4.1 and 2.2, text or binary.

#include <filesystem>

#include "mesh/files/mesh_file.h"

namespace pfdm {

/// The physical groups are the cell array "gmsh:physical" (0: in none), with the names of volumes and surfaces as those
/// of regions and patches; a surface group without a name is patch_<number>, what is in no volume group "body". Throws
/// InputError naming the path, the place and the reason: another format, elements of second or higher order, a mesh in
/// partitions, an element in two groups of its dimension.
MeshFile read_gmsh_file(const std::filesystem::path& path);

}  // namespace pfdm
