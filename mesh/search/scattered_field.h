#pragma once
// Fields known at scattered points (CGAL's Delaunay triangulations).

#include "mesh/search/known_places.h"

namespace pfdm {

/// A field known at points [m], linear in the tetrahedra between them (Delaunay), in the triangles or intervals where
/// it varies along two or one of the coordinates. Throws InputError if the points do not span these, or one is at the
/// place of another.
KnownField scattered_field(const std::vector<Vector>& points, const std::array<bool, 3>& varies);

}  // namespace pfdm
