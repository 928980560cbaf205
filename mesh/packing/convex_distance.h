#pragma once
// Convex bodies, the hulls of points: how far apart two of them are.

#include "mesh/fields.h"

#include <vector>

namespace pfdm {

/// The corners of the convex hull of these points (CGAL), in their order.
std::vector<Vector> hull_corners(const std::vector<Vector>& points);

/// A hull that is scaled, turned, then moved.
struct PlacedHull {
  const std::vector<Vector>* corners = nullptr;  ///< not none [m]
  double scale = 1.0;
  Tensor rotation = Tensor::Identity();
  Vector centre = Vector::Zero();  ///< [m]

  /// The corner that is farthest along a direction [m].
  Vector farthest(const Vector& direction) const;
};

/// Whether two bodies are at least so far from each other; 0: whether they do not overlap. By the distance of the
/// origin from their difference (Gilbert, Johnson, Keerthi, IEEE J. Robot. Autom. 4 (1988) 193).
bool are_apart(const PlacedHull& a, const PlacedHull& b, double distance);

}  // namespace pfdm
