#pragma once

#include "physics/tensor.h"

#include <cstdint>

namespace pfdm::verification {

/// Numbers between -1 and 1, always the same: a linear congruential generator.
class Noise {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return double(state_ >> 11) / double(1ULL << 52) - 1.0;
  }
  Vector vector() { return {next(), next(), next()}; }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace pfdm::verification
