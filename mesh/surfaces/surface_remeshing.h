#pragma once
// A surface with triangles of one wanted size (CGAL, Polygon Mesh Processing).

#include <numbers>

#include "mesh/surfaces/surface_checks.h"

namespace pfdm {

/// Edges at which the surface turns by more than `sharp` [radian] stay where they are and are only divided; elsewhere
/// edges are split, collapsed and flipped and points move in the surface (Botsch, Kobbelt, Proc. Symp. Geometry
/// Processing (2004) 189). Sharp edges that are shorter than `size` stay short. The same input gives the same surface.
/// Throws InputError that names the surface, as check_surfaces() does, and where it has more than one piece.
TriangleSurface remeshed(const NamedSurface& given, double size, double sharp = 0.25 * std::numbers::pi);

/// The same of a particle; throws InputError too where the triangles leave less than 0.7 of its volume.
TriangleSurface remeshed_body(const NamedSurface& given, double size, double sharp);

}  // namespace pfdm
