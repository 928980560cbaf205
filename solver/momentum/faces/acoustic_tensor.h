#pragma once
// Normal stiffness of a material as the faces of cells see it.

#include "physics/elasticity/anisotropy.h"

namespace pfdm {

/// n.C.n [Pa]: what C makes of v (x) n, as a traction on n.
inline Tensor acoustic_tensor(const MandelMatrix& C, const Vector& n) {
  const Eigen::Matrix<double, 6, 3> strain = strains_across(n);
  return strain.transpose() * C * strain;
}

/// (h_P A_P^-1 + h_N A_N^-1)^-1 [Pa/m] of two of them [Pa] over distances [m].
inline Tensor in_series(const Tensor& A_P, double h_P, const Tensor& A_N, double h_N) {
  return symmetric_part((h_P * A_P.inverse() + h_N * A_N.inverse()).inverse());
}

}  // namespace pfdm
