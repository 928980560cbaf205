#pragma once
// Symmetric tensors as vectors of six (Mandel): 11, 22, 33, sqrt(2) 23, sqrt(2) 13, sqrt(2) 12. Stress and strain
// alike, so that the dot product is the double contraction and the norm that of the tensor.

#include "physics/elasticity/elasticity.h"
#include "physics/tensor.h"

#include <array>
#include <numbers>
#include <string_view>

namespace pfdm {

using Mandel = Eigen::Matrix<double, 6, 1>;
using MandelMatrix = Eigen::Matrix<double, 6, 6>;

constexpr int n_components = 6;
constexpr std::array<std::string_view, 6> component_names{"xx", "yy", "zz", "yz", "xz", "xy"};

/// Factor of the tensor component k in its Mandel vector.
constexpr double mandel_factor(int k) { return k < 3 ? 1.0 : std::numbers::sqrt2; }

inline Mandel to_mandel(const Tensor& a) {
  constexpr double r = std::numbers::sqrt2;
  return Mandel{a(0, 0), a(1, 1), a(2, 2), r * a(1, 2), r * a(0, 2), r * a(0, 1)};
}

inline Tensor to_tensor(const Mandel& v) {
  const double yz = v[3] / std::numbers::sqrt2, xz = v[4] / std::numbers::sqrt2, xy = v[5] / std::numbers::sqrt2;
  Tensor a;
  a << v[0], xy, xz, xy, v[1], yz, xz, yz, v[2];
  return a;
}

inline double trace(const Mandel& v) { return v[0] + v[1] + v[2]; }

inline Mandel mandel_identity() { return Mandel{1.0, 1.0, 1.0, 0.0, 0.0, 0.0}; }

inline Mandel deviator(const Mandel& v) { return v - (trace(v) / 3.0) * mandel_identity(); }

/// I (x) I / 3; the unit matrix less this takes the deviator.
inline MandelMatrix volumetric_projector() {
  MandelMatrix P = MandelMatrix::Zero();
  P.topLeftCorner<3, 3>().setConstant(1.0 / 3.0);
  return P;
}

inline MandelMatrix deviatoric_projector() { return MandelMatrix::Identity() - volumetric_projector(); }

/// C of sigma = C eps [Pa].
inline MandelMatrix stiffness_matrix(const IsotropicElasticity& c) {
  return 3.0 * c.lambda * volumetric_projector() + 2.0 * c.mu * MandelMatrix::Identity();
}

}  // namespace pfdm
