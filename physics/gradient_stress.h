#pragma once
// First Piola-Kirchhoff stress as a linear function of the displacement gradient H = F - 1: a law of finite strain,
// linearised.

#include "physics/tensor.h"

namespace pfdm {

/// d P_iJ / d H_kL [Pa] in row 3 i + J and column 3 k + L. It has no minor symmetries, and no major one where the law
/// is not associated.
using GradientTangent = Eigen::Matrix<double, 9, 9>;

/// The components 3 i + J of a tensor, and back.
using Components = Eigen::Matrix<double, 9, 1>;
inline Components to_components(const Tensor& a) {
  return (Components() << a(0, 0), a(0, 1), a(0, 2), a(1, 0), a(1, 1), a(1, 2), a(2, 0), a(2, 1), a(2, 2)).finished();
}
inline Tensor from_components(const Components& v) {
  return (Tensor() << v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]).finished();
}

/// P = A : H + initial.
struct GradientStress {
  GradientTangent A = GradientTangent::Zero();  ///< [Pa]
  Tensor initial = Tensor::Zero();              ///< [Pa]
};

/// N.A.N [Pa]: what A makes of v (x) N, as a traction on N.
inline Tensor acoustic_tensor(const GradientTangent& A, const Vector& N) {
  Tensor Q = Tensor::Zero();
  for (Index i = 0; i < 3; ++i)
    for (Index k = 0; k < 3; ++k) Q(i, k) = N.dot(A.block<3, 3>(3 * i, 3 * k) * N);
  return Q;
}

}  // namespace pfdm
