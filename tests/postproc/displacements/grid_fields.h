#pragma once
// Measured fields on a grid of points, and what a computed field has at places.

#include "postproc/displacements/displacement_field.h"

#include <functional>
#include <utility>
#include <vector>

namespace pfdm {

/// Of a grid in the plane, n points each way, `spacing` apart.
inline RecordedFrame grid_frame(int n, double spacing, const std::function<Vector(const Vector&)>& u) {
  RecordedFrame frame{.name = "1", .displacement = 1.0, .points = {}, .u = {}};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      frame.points.emplace_back(spacing * (i + 0.5), spacing * (j + 0.5), 0.0);
      frame.u.push_back(u(frame.points.back()));
    }
  return frame;
}

inline Vector zero(const Vector&) { return Vector::Zero(); }

inline RecordedField field_of(std::vector<RecordedFrame> frames) {
  return {.name = "front", .frames = std::move(frames)};
}

/// Computed displacements of all places by a function of the place in the body.
inline std::vector<double> computed_by(const std::vector<FieldPlace>& places,
                                       const std::function<Vector(const Vector&)>& u) {
  std::vector<double> row;
  for (const FieldPlace& place : places) {
    Vector mean = Vector::Zero();
    for (const Vector& x : place.points) mean += u(x) / static_cast<double>(place.points.size());
    row.insert(row.end(), mean.begin(), mean.end());
  }
  return row;
}

}  // namespace pfdm
