#include "mesh/surfaces/size_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

double distance_to_nearest(const std::vector<Vector>& points, const Vector& x) {
  double square = std::numeric_limits<double>::infinity();
  for (const Vector& point : points) square = std::min(square, (x - point).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

double SizeField::operator()(const Vector& x) const {
  double size = size_far_;
  for (const SizeSource& s : sources_) {
    const double distance = (x - s.centre).norm();
    if (distance < s.core) return std::min(s.core_limit, s.core_size + grading_ * (s.core - distance));
    const double outside = s.outer_size + grading_ * std::max(0.0, distance - s.radius);
    if (s.points.empty())
      size = std::min(size, outside);
    else if (outside < size)
      size = std::min(size, s.outer_size + grading_ * distance_to_nearest(s.points, x));
  }
  return size;
}

}  // namespace pfdm
