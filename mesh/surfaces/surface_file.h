#pragma once
// Surfaces of triangles from files: STL, text or binary, and OBJ of Wavefront.

#include <cstddef>
#include <filesystem>

#include "mesh/surfaces/triangle_surface.h"

namespace pfdm {

/// In the file's unit of length. Points that are equal to the last digit become one; of OBJ, whose points have numbers,
/// `n_merged` tells how many went into others. Polygons of OBJ are cut into fans; normals, textures and groups are left
/// out, and so are points of no triangle. What the file is, its name's end tells (.stl, .obj). Throws InputError that
/// names the file, the place in it and what is wrong: no such kind of file, a line or number that cannot be read, a
/// point that does not exist, a triangle without area.
TriangleSurface read_surface_file(const std::filesystem::path& path, std::size_t* n_merged = nullptr);

}  // namespace pfdm
