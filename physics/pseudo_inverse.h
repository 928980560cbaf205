#pragma once
// Inverse of a symmetric tensor where it has one (Moore and Penrose).

#include "physics/tensor.h"

#include <Eigen/Eigenvalues>

namespace pfdm {

/// Of a positive semidefinite tensor: directions whose eigenvalue is no more than this part of the largest have none.
inline Tensor pseudo_inverse(const Tensor& symmetric, double least) {
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(symmetric);
  Tensor inverse = Tensor::Zero();
  for (Index i = 0; i < 3; ++i) {
    const double value = eigen.eigenvalues()[i];
    const Vector along = eigen.eigenvectors().col(i);
    if (value > least * eigen.eigenvalues()[2]) inverse += along * along.transpose() / value;
  }
  return inverse;
}

}  // namespace pfdm
