#pragma once
// A separation in the terms of an interface law, its traction and its losses: for interface_law.cpp and
// interface_losses.cpp.

#include "physics/interfaces/interface_law.h"
#include "physics/interfaces/xu_needleman.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

/// Mean over a step, from the values at its two ends.
inline double mean_of_ends(double a, double b) { return 0.5 * (a + b); }

/// The potential of the rule xu_needleman.
inline XuNeedleman potential_of(const InterfaceStrength& at) {
  return XuNeedleman::of(at.strength, at.toughness, at.shear_strength, at.shear_toughness);
}

/// A separation in the terms of the law.
struct InterfaceLaw::Opening {
  double normal;    // delta_n [m]
  Vector n, shear;  // delta_s [m]
  double rho, k;
  Vector measured;  // <delta_n> n + rho delta_s [m], whose product with the separation is lambda^2
  Tensor along;     // n n^T where it is open, k along the face
  Vector pulled;    // along separation [m], which the traction is along
  double lambda;    // [m]
  double B;         // mode mixity

  Opening(const InterfaceLaw& law, const Vector& normal_vector, const Vector& separation)
      : normal(normal_vector.dot(separation)), n(normal_vector), shear(separation - normal * n) {
    const double beta2 = law.shear_ratio * law.shear_ratio;
    rho = law.mixed_mode->keeps_stiffness ? 1.0 / beta2 : beta2;
    k = law.mixed_mode->keeps_stiffness ? 1.0 : beta2;
    measured = weighted(rho) * separation;
    along = weighted(k);
    pulled = along * separation;
    lambda = std::sqrt(measured.dot(separation));
    B = lambda > 0.0 ? std::min(1.0, rho * shear.squaredNorm() / (lambda * lambda)) : 0.0;
  }
  /// Opening as far as `history` tells. Turned with the body: only the length of the slip counts.
  static Opening of(const InterfaceLaw& law, const Vector& n, const InterfaceHistory& history) {
    return Opening(law, n, history.opening * n + history.shear.norm() * n.unitOrthogonal());
  }
  bool is_closed() const { return normal < 0.0; }
  double opened() const { return std::max(0.0, normal); }
  // Energy of a separation over that of the law in opening at the same lambda. Traction and separation are not those of
  // one potential where rho and k differ.
  double share() const { return 1.0 - B + B * k / rho; }
  Vector share_slope() const { return 2.0 / (lambda * lambda) * (pulled - share() * measured); }
  Vector B_slope() const { return 2.0 / (lambda * lambda) * (rho * shear - B * measured); }

 private:
  Tensor weighted(double in_shear) const {
    Tensor weights = in_shear * (Tensor::Identity() - n * n.transpose());
    if (normal >= 0.0) weights += n * n.transpose();
    return weights;
  }
};

/// T less what contact and friction add, and its derivative in two parts: `secant` separation + what changes it.
struct InterfaceLaw::Pull {
  Tensor secant;         // [Pa/m]
  Tensor secant_change;  // T's derivative less it [Pa/m]
  Vector traction;       // [Pa]
  double shear;          // S_s of T_s = S_s delta_s [Pa/m]
  Vector shear_slope;    // its derivative by the separation
};

/// Energy that a step dissipates [J/m^2], with its derivative by the separation at the step's end [Pa].
struct InterfaceLaw::Loss {
  double energy;
  Vector slope;
};

}  // namespace pfdm
