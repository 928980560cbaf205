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

/// det(1 + H) - 1, exact to rounding for small H.
inline double volume_change(const Tensor& H) {
  const double second = 0.5 * (H.trace() * H.trace() - (H * H).trace());
  return H.trace() + second + H.determinant();
}

/// cof F = J F^-T, of any F: area vectors S of the reference become cof F S.
inline Tensor cofactor(const Tensor& F) {
  Tensor cof;
  cof.col(0) = F.col(1).cross(F.col(2));
  cof.col(1) = F.col(2).cross(F.col(0));
  cof.col(2) = F.col(0).cross(F.col(1));
  return cof;
}

/// Change of cof F at F in the direction G.
inline Tensor cofactor_change(const Tensor& F, const Tensor& G) {
  Tensor change;
  change.col(0) = F.col(1).cross(G.col(2)) + G.col(1).cross(F.col(2));
  change.col(1) = F.col(2).cross(G.col(0)) + G.col(2).cross(F.col(0));
  change.col(2) = F.col(0).cross(G.col(1)) + G.col(0).cross(F.col(1));
  return change;
}

/// N.A.N [Pa]: what A makes of v (x) N, as a traction on N.
inline Tensor acoustic_tensor(const GradientTangent& A, const Vector& N) {
  Tensor Q = Tensor::Zero();
  for (Index i = 0; i < 3; ++i)
    for (Index k = 0; k < 3; ++k) Q(i, k) = N.dot(A.block<3, 3>(3 * i, 3 * k) * N);
  return Q;
}

}  // namespace pfdm
