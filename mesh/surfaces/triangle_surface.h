#pragma once
// Triangulated surfaces: what bounds the regions that TetGen fills.

#include <array>
#include <string_view>
#include <vector>

#include "mesh/fields.h"

namespace pfdm {

using Triangle = std::array<Index, 3>;

struct TriangleSurface {
  std::vector<Vector> points;       ///< [m]
  std::vector<Triangle> triangles;  ///< counter-clockwise when seen from outside
};

/// Throws InputError, which names the surface, if more equilateral triangles with this edge [m] cover the area [m^2]
/// than a mesh can be made from.
void require_few_triangles(std::string_view surface, double area, double edge);

/// The unit sphere: each side of an icosahedron cut n-fold, all points moved onto the sphere. 20 n^2 triangles,
/// 10 n^2 + 2 points. Throws InputError for n < 1, and as require_few_triangles does.
TriangleSurface unit_icosphere(Index n);

/// Side of the equilateral triangle that has the mean area of an icosphere's triangles [m], and the other way round
/// the subdivision that comes closest to a wanted side (at least 1).
double icosphere_size(Index n, double radius);
Index icosphere_subdivision(double size, double radius);

}  // namespace pfdm
