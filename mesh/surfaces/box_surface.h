#pragma once
// The surface of a box, triangulated at its final size: TetGen, told to keep the boundary, puts no points there.

#include <array>
#include <vector>

#include "mesh/surfaces/size_field.h"
#include "mesh/surfaces/triangle_surface.h"

namespace pfdm {

/// Coordinates [m] of the box's surface grid along x, y and z.
using BoxNodes = std::array<std::vector<double>, 3>;

/// Nodes at equal steps of about the wanted size [m].
BoxNodes uniform_box_nodes(const Vector& lower, const Vector& upper, double size);

/// Nodes that follow the size field on the box's surface. The largest step is kept below twice the smallest wanted, so
/// that triangles stay well shaped where fine steps of one axis cross coarse ones of another.
BoxNodes graded_box_nodes(const Vector& lower, const Vector& upper, const SizeField& size);

/// Every rectangle of the six grids cut into two triangles, the cuts alternating; edges of the box match.
TriangleSurface box_surface(const BoxNodes& nodes);

}  // namespace pfdm
