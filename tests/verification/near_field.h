#pragma once
// The displacement around the tip of a crack along -x (Williams, J. Appl. Mech. 24 (1957) 109), plane strain:
//   u = (K_I/2 mu) sqrt(r/2 pi) (kappa - cos f) (cos f/2, sin f/2),  kappa = 3 - 4 nu, in mode I.

#include "physics/elasticity/elasticity.h"
#include "physics/tensor.h"

#include <cmath>
#include <numbers>

namespace pfdm::verification {

/// [m] at x [m] from the tip; K_I, K_II [Pa m^1/2].
inline Vector near_field(const IsotropicElasticity& elasticity, const Vector& x, double K_I, double K_II = 0.0) {
  const double nu = 0.5 * elasticity.lambda / (elasticity.lambda + elasticity.mu), kappa = 3.0 - 4.0 * nu;
  const double r = std::hypot(x.x(), x.y()), f = std::atan2(x.y(), x.x());
  const double scale = std::sqrt(r / (2.0 * std::numbers::pi)) / (2.0 * elasticity.mu);
  const double c = std::cos(0.5 * f), s = std::sin(0.5 * f);
  return scale * Vector(K_I * (kappa - std::cos(f)) * c + K_II * (kappa + 2.0 + std::cos(f)) * s,
                        K_I * (kappa - std::cos(f)) * s - K_II * (kappa - 2.0 + std::cos(f)) * c, 0.0);
}

/// The field whose stresses grow with r^(1/2), which comes next after a uniform stress (Williams' series, n = 3): of
/// mode I with `a` and of mode II with `b` [Pa m^-1/2]; its stresses are a and b times r^(1/2) and functions of f.
inline Vector next_field(const IsotropicElasticity& elasticity, const Vector& x, double a, double b) {
  const double nu = 0.5 * elasticity.lambda / (elasticity.lambda + elasticity.mu), kappa = 3.0 - 4.0 * nu;
  const double r = std::hypot(x.x(), x.y()), f = std::atan2(x.y(), x.x());
  const double scale = r * std::sqrt(r) / (2.0 * elasticity.mu);
  const double c = std::cos(0.5 * f), s = std::sin(0.5 * f), c3 = std::cos(1.5 * f), s3 = std::sin(1.5 * f);
  return scale * Vector(a * ((kappa + 0.5) * c3 - 1.5 * c) - b * ((kappa + 2.5) * s3 + 1.5 * s),
                        a * ((kappa - 0.5) * s3 - 1.5 * s) + b * ((kappa - 2.5) * c3 + 1.5 * c), 0.0);
}

}  // namespace pfdm::verification
