#include "physics/interfaces/interface_crack.h"

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Complex = std::complex<double>;

double kolosov(const IsotropicElasticity& c, bool plane_stress) {
  const double nu = c.poisson_ratio();
  return plane_stress ? (3.0 - nu) / (1.0 + nu) : 3.0 - 4.0 * nu;
}

double plane_modulus(const IsotropicElasticity& c, bool plane_stress) {
  const double nu = c.poisson_ratio();
  return plane_stress ? c.young_modulus() : c.young_modulus() / (1.0 - nu * nu);
}

}  // namespace

double InterfaceCrack::oscillation() const {
  const double above = kolosov(upper, plane_stress) / upper.mu + 1.0 / lower.mu;
  const double below = kolosov(lower, plane_stress) / lower.mu + 1.0 / upper.mu;
  return std::log(above / below) / (2.0 * std::numbers::pi);
}

double InterfaceCrack::modulus() const {
  const double cosh = std::cosh(std::numbers::pi * oscillation());
  return 2.0 * cosh * cosh / (1.0 / plane_modulus(upper, plane_stress) + 1.0 / plane_modulus(lower, plane_stress));
}

// Potentials phi' and psi' = omega - (z phi')' of Muskhelishvili, with phi' = A z^(-1/2 - i eps), omega = B z^(-1/2 + i
// eps): free of traction behind the tip if B = exp(2 pi eps) conj A above and exp(-2 pi eps) conj A below.
NearField near_field(const InterfaceCrack& crack, double along, double across, Complex K) {
  const bool above = across >= 0.0;
  const IsotropicElasticity& c = above ? crack.upper : crack.lower;
  const double eps = crack.oscillation(), growth = std::exp((above ? 2.0 : -2.0) * std::numbers::pi * eps);
  const Complex i(0.0, 1.0), z(along, across + 0.0), log_z(std::log(std::abs(z)), std::arg(z));
  const Complex A = std::conj(K) / ((1.0 + growth) * std::sqrt(2.0 * std::numbers::pi)), B = growth * std::conj(A);
  const Complex to_length = i * eps * std::log(crack.reference_length);
  const Complex phi = A * std::exp((-0.5 - i * eps) * log_z + to_length);
  const Complex phi_slope = (-0.5 - i * eps) * phi / z;
  const Complex omega = B * std::exp((-0.5 + i * eps) * log_z - to_length);
  const Complex traction = std::conj(phi) + omega + (std::conj(z) - z) * phi_slope;  // s_yy + i s_xy
  NearField field;
  field.slope = (kolosov(c, crack.plane_stress) * phi - std::conj(omega) - (z - std::conj(z)) * std::conj(phi_slope)) /
                (2.0 * c.mu);
  field.s_yy = traction.real();
  field.s_xy = traction.imag();
  field.s_xx = 4.0 * phi.real() - field.s_yy;
  return field;
}

}  // namespace pfdm
