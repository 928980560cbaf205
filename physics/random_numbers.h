#pragma once
// Random numbers.

#include "physics/tensor.h"

#include <cstdint>
#include <random>

namespace pfdm {

/// Numbers that are the same on every machine (the standard leaves its distributions open, not its engines).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }  ///< of [0, 1)
  double normal();    ///< mean 0, variance 1 (Box, Muller, Ann. Math. Stat. 29 (1958) 610)
  Tensor rotation();  ///< all alike probable

 private:
  std::mt19937_64 engine_;
};

}  // namespace pfdm
