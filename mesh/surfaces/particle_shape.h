#pragma once
// Particles of any shape: a closed surface, its place, and its offset outwards by the thickness of layers.

#include "mesh/surfaces/triangle_surface.h"

namespace pfdm {

/// Centroid of the body that a closed surface bounds [m].
Vector centroid(const TriangleSurface& surface);

/// The surface with its centroid at the origin, scaled, then turned.
TriangleSurface about_centroid(TriangleSurface surface, double scale, const Tensor& rotation);

/// For each point how far it moves [-] where the surface moves outwards by 1: all triangles around it keep their
/// distance of 1 from where they were (by least squares where more than three planes meet), so that the sides of a cube
/// stay plane.
std::vector<Vector> offset_directions(const TriangleSurface& surface);

/// A point well inside the body.
Vector point_inside(const TriangleSurface& surface);

/// Is x in the body? (Solid angle of the triangles: van Oosterom, Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.)
bool encloses(const TriangleSurface& surface, const Vector& x);

}  // namespace pfdm
