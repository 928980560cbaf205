#include "mesh/size_field.h"

#include <algorithm>

namespace pfdm {

double SizeField::operator()(const Vector& x) const {
  double size = size_far_;
  for (const SizeSource& s : sources_) {
    const double distance = (x - s.centre).norm();
    if (distance < s.core) return std::min(s.core_limit, s.core_size + grading_ * (s.core - distance));
    size = std::min(size, s.outer_size + grading_ * std::max(0.0, distance - s.radius));
  }
  return size;
}

}  // namespace pfdm
