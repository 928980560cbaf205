#pragma once
// A checksum that tells whether two results agree to the last bit.

#include "physics/tensor.h"

#include <bit>
#include <cstdint>

namespace pfdm {

/// FNV-1a (Fowler, Noll, Vo) of 64 bits, over words; -0 counts as 0.
class Checksum {
 public:
  void add(std::uint64_t word) { sum_ = (sum_ ^ word) * 0x100000001b3U; }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x == 0.0 ? 0.0 : x)); }
  void add(const Vector& x) {
    for (const double component : x) add(component);
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325U;
};

}  // namespace pfdm
