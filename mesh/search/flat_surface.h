#pragma once
// Plane surfaces with an outline, and the cells that they go through: cracks that are there from the beginning.

#include "mesh/mesh.h"

#include <functional>

namespace pfdm {

struct FlatSurface {
  Vector point;                                   ///< anywhere in the plane [m]
  Vector normal;                                  ///< of length 1
  std::function<bool(const Vector& x)> has_foot;  ///< whether x [m], projected on the plane, is within the outline
};

/// Around the centre, which normal and radius [m] belong to.
FlatSurface disc(const Vector& centre, const Vector& normal, double radius);
/// Straight from one point to the other [m], and without end to both sides along `front`. Throws InputError where these
/// are parallel or the points are one.
FlatSurface strip(const Vector& from, const Vector& to, const Vector& front);
/// With these corners [m], in order. Throws InputError if they are fewer than three, or not in one plane.
FlatSurface polygon(const std::vector<Vector>& corners);

/// The cells that the surface goes through, in ascending order, as few as keep its two sides apart: no face joins cells
/// beside them whose centres are on two sides. An oblique surface takes cells of hexahedra that meet at edges. Where it
/// lies on faces, those on the side that its normal points to; on the boundary those that are there. A cell counts
/// where the foot of its centre is within the outline.
std::vector<Index> cells_on(const Mesh& mesh, const FlatSurface& surface);

}  // namespace pfdm
