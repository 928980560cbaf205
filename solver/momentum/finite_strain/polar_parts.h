#pragma once
// Rotation and stretch of a deformation gradient.

#include "physics/tensor.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pfdm {

/// F = R U.
struct PolarParts {
  Tensor R, U;
};

/// Stretches below 1e-3 count as 1e-3.
inline PolarParts polar_parts(const Tensor& F) {
  constexpr double least = 1e-3;
  const Eigen::SelfAdjointEigenSolver<Tensor> C(F.transpose() * F);
  Vector stretches, inverse;
  for (int i = 0; i < 3; ++i) {
    stretches[i] = std::max(std::sqrt(std::max(C.eigenvalues()[i], 0.0)), least);
    inverse[i] = 1.0 / stretches[i];
  }
  return {.R = F * C.eigenvectors() * inverse.asDiagonal() * C.eigenvectors().transpose(),
          .U = C.eigenvectors() * stretches.asDiagonal() * C.eigenvectors().transpose()};
}

}  // namespace pfdm
