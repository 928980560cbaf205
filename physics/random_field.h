#pragma once
// A stationary Gaussian random field of mean 0, variance 1 and covariance exp(-r^2/(2 L^2)), as a sum of plane waves
// with random wave vectors and phases (Shinozuka, Jan, J. Sound Vib. 25 (1972) 111). The same seed gives the same field
// on any mesh and machine.

#include "physics/tensor.h"

#include <cstdint>
#include <vector>

namespace pfdm {

class RandomField {
 public:
  /// The correlation length L is in [m].
  RandomField(std::uint64_t seed, double correlation_length);
  double at(const Vector& x) const;

 private:
  struct Wave {
    Vector k;      // [1/m]
    double phase;  // [rad]
  };
  std::vector<Wave> waves_;
};

}  // namespace pfdm
