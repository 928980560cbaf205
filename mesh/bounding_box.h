#pragma once
// Boxes along the axes, and the one around points.

#include <span>

#include "mesh/fields.h"

namespace pfdm {

struct Box {
  Vector low, high;  ///< corners [m]
};

/// The smallest box along the axes around at least one point.
inline Box bounding_box(std::span<const Vector> points) {
  Box box{points.front(), points.front()};
  for (const Vector& x : points) box = {box.low.cwiseMin(x), box.high.cwiseMax(x)};
  return box;
}

}  // namespace pfdm
