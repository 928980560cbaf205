#pragma once
// A triangulated unit sphere, finer where it has to be.

#include "mesh/surfaces/triangle_surface.h"

#include <functional>

namespace pfdm {

/// Bisects triangles at their longest edge until none is longer than wanted at the triangle's middle; new points lie on
/// the unit sphere. A triangle is bisected together with the one on the other side of that edge, once it is the longest
/// of both (Rivara, Int. J. Numer. Meth. Eng. 20 (1984) 745): no angle becomes less than half the smallest one.
TriangleSurface refined_sphere(TriangleSurface sphere, const std::function<double(const Vector& direction)>& wanted);

/// Of a closed surface that looks outwards [m^3].
double enclosed_volume(const TriangleSurface& surface);

}  // namespace pfdm
