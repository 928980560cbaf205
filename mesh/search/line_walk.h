#pragma once
// A straight line through the cells of a mesh.

#include "mesh/mesh.h"

#include <vector>

namespace pfdm {

/// A piece of a line within one cell.
struct LineSegment {
  Index cell = 0;
  Index entry = -1, exit = -1;  ///< faces; -1 where the line begins or ends within the cell
  double begin = 0.0;           ///< distance along the line [m]
  double length = 0.0;          ///< [m]
};

/// The segments from `point` [m], which lies in `cell` or on its faces, along the unit vector `direction` for `length`
/// [m] or up to the boundary, in their order; none is empty. Exact for convex cells with plane faces; other faces are
/// taken as plane.
std::vector<LineSegment> walk_line(const Mesh& mesh, Index cell, const Vector& point, const Vector& direction,
                                   double length);

}  // namespace pfdm
