#include "physics/closed_forms/bars.h"

#include <cmath>
#include <numbers>

namespace pfdm {

double at1_strength(double E, double Gc, double ell) { return std::sqrt(3.0 * E * Gc / (8.0 * ell)); }

double at2_strength(double E, double Gc, double ell) { return 9.0 / 16.0 * std::sqrt(E * Gc / (3.0 * ell)); }

// sigma = sigma_c sqrt(2) s / sqrt(1+s) with s = 1 - d_max, and
// w = (3 sqrt2/4) (Gc/sigma_c) s int_s^1 (1+x) sqrt(1-x) / (x sqrt((x-s)(x+s+xs))) dx;
// x = s + (1-s) sin^2 p takes the root out of the integrand, which the midpoint rule then integrates.
BarPoint at1_softening(double E, double Gc, double ell, double d_max) {
  const double s = 1.0 - d_max;
  const double strength = at1_strength(E, Gc, ell);
  constexpr int n = 4000;
  double integral = 0.0;
  for (int i = 0; i < n; ++i) {
    const double p = 0.5 * std::numbers::pi * (i + 0.5) / n;
    const double sine = std::sin(p), cosine = std::cos(p);
    const double x = s + (1.0 - s) * sine * sine;
    integral += (1.0 + x) * 2.0 * (1.0 - s) * cosine * cosine / (x * std::sqrt(x + s + x * s));
  }
  integral *= 0.5 * std::numbers::pi / n;
  return {.stress = strength * std::numbers::sqrt2 * s / std::sqrt(1.0 + s),
          .separation = 0.75 * std::numbers::sqrt2 * Gc / strength * s * integral};
}

BarPoint at2_softening(double E, double Gc, double ell, double d_far) {
  const double D = d_far;
  const double sigma = std::sqrt(E * Gc / ell) * std::sqrt(D) * std::pow(1.0 - D, 1.5);
  const double w =
      2.0 * sigma * ell / (E * (1.0 - D) * (1.0 - D)) *
      (std::acosh((1.0 - 2.0 * D) / std::sqrt(D)) + std::sqrt((1.0 - D) / D) * std::acos(2.0 * std::sqrt(D)));
  return {.stress = sigma, .separation = w};
}

// sigma = ft sqrt((2-d)(1-d)^p / (2 P(d))),
// w = (8 Gf sigma/(pi ft^2)) int_0^d sqrt(b) P(b) (1-b)^-p / sqrt((2-b) - (2-d) (P(b)/P(d)) ((1-d)/(1-b))^p) db;
// b = d sin^2 t takes the root out of the integrand.
BarPoint pfczm_softening(const SofteningLaw& law, double Gf, double ft, double d_max) {
  const RationalCoefficients c = rational_coefficients(law, 1.0, 1.0, 1.0, 1.0);  // all but a1 are the law's alone
  const auto P = [&](double b) { return 1.0 + c.a2 * b * (1.0 + c.a3 * b); };
  const double sound = 1.0 - d_max;
  const double sigma = ft * std::sqrt((2.0 - d_max) * std::pow(sound, c.p) / (2.0 * P(d_max)));
  constexpr int n = 20000;
  double integral = 0.0;
  for (int i = 0; i < n; ++i) {
    const double t = 0.5 * std::numbers::pi * (i + 0.5) / n;
    const double sine = std::sin(t), b = d_max * sine * sine;
    const double root = (2.0 - b) - (2.0 - d_max) * (P(b) / P(d_max)) * std::pow(sound / (1.0 - b), c.p);
    integral += std::sqrt(b) * P(b) * std::pow(1.0 - b, -c.p) / std::sqrt(root) * d_max * std::sin(2.0 * t);
  }
  integral *= 0.5 * std::numbers::pi / n;
  return {.stress = sigma, .separation = 8.0 * Gf * sigma / (std::numbers::pi * ft * ft) * integral};
}

double at1_discrete_toughness(double h, double ell) { return 1.0 + h * h / (32.0 * ell * ell); }

double at2_discrete_toughness(double h, double ell) { return std::sqrt(1.0 + h * h / (4.0 * ell * ell)); }

}  // namespace pfdm
