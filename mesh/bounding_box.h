#pragma once
// The box around points.

#include <span>

#include "mesh/fields.h"

namespace pfdm {

struct BoundingBox {
  Vector low, high;  ///< corners [m]
};

/// The smallest box along the axes around at least one point.
inline BoundingBox bounding_box(std::span<const Vector> points) {
  BoundingBox box{points.front(), points.front()};
  for (const Vector& x : points) box = {box.low.cwiseMin(x), box.high.cwiseMax(x)};
  return box;
}

}  // namespace pfdm
