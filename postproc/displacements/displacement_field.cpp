#include "postproc/displacements/displacement_field.h"

#include <bit>

namespace pfdm {

std::uint64_t hash_of(const std::vector<FieldPlace>& places) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](std::uint64_t word) {
    for (int k = 0; k < 8; ++k) hash = (hash ^ (word >> (8 * k) & 0xff)) * 1099511628211u;
  };
  for (const FieldPlace& place : places) {
    add(place.points.size());
    for (const Vector& x : place.points)
      for (int i = 0; i < 3; ++i) add(std::bit_cast<std::uint64_t>(x[i]));
  }
  return hash;
}

}  // namespace pfdm
