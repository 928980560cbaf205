#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace pfdm {

/// Numbers between -0.5 and 0.5 that reference values elsewhere were made from: a linear congruential generator.
inline Eigen::VectorXd congruential(Eigen::Index n, std::uint64_t seed) {
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    seed = (1103515245 * seed + 12345) % 2147483648;
    x[i] = static_cast<double>(seed) / 2147483648.0 - 0.5;
  }
  return x;
}

}  // namespace pfdm
