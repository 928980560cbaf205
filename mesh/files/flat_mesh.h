#pragma once
// Flat meshes, of triangles, quadrilaterals and polygons in a plane normal to an axis, and the layer of cells made of
// them.

#include <optional>

#include "mesh/files/mesh_file.h"

namespace pfdm {

/// The axis (0, 1, 2) that a mesh's faces are normal to; nothing if it has volume cells, no faces, or faces of another
/// plane.
std::optional<int> flat_along(const MeshFile& file);

/// Turns a flat mesh into one layer of cells, from its plane to `thickness` beyond, in the file's unit, along the axis:
/// triangles become wedges, quadrilaterals hexahedra, polygons polyhedra. They keep their numbers, which are those of
/// regions now; lines become quadrilaterals, whose numbers may name patches. The names follow.
void extrude(MeshFile& file, int axis, double thickness);

}  // namespace pfdm
