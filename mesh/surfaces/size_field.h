#pragma once
// The cell size that is wanted at a point: that of the nearest particle's surface, growing with the distance from it
// on both sides.

#include <vector>

#include "mesh/fields.h"

namespace pfdm {

/// A ball around which cells are fine.
struct SizeSource {
  Vector centre;      ///< [m]
  double radius;      ///< particle with its layers [m]
  double outer_size;  ///< wanted on the ball's surface [m]
  double core;        ///< radius of the particle without its layers [m]
  double core_size;   ///< wanted on the particle's surface [m]
  double core_limit;  ///< largest wanted inside the particle [m]
  /// Of a particle that is no sphere: points of its surface with its layers, all in that ball. Both sizes are then
  /// outer_size, wanted where they are, and nothing limits the size inside [m]
  std::vector<Vector> points{};
};

class SizeField {
 public:
  /// grading [-]: growth of the size per distance; size_far [m] caps it.
  SizeField(std::vector<SizeSource> sources, double grading, double size_far)
      : sources_(std::move(sources)), grading_(grading), size_far_(size_far) {}

  /// Wanted edge length [m].
  double operator()(const Vector& x) const;

  const std::vector<SizeSource>& sources() const { return sources_; }

 private:
  std::vector<SizeSource> sources_;
  double grading_;
  double size_far_;
};

}  // namespace pfdm
