#include "physics/damage/degradation.h"

#include "physics/registry.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr DegradationLaw quadratic{
    .name = "quadratic",
    .description = "g = (1 - d)^2",
    .needs_strength = false,
    .g = [](double d, const LawParameters&) { return (1.0 - d) * (1.0 - d); },
    .g_prime = [](double d, const LawParameters&) { return -2.0 * (1.0 - d); },
    .g_second = [](double, const LawParameters&) { return 2.0; },
};

// Intact share s = (1-d)^p and lost share q = a1 d (1 + a2 d + a2 a3 d^2), with their derivatives: g = s/(s+q).
struct Shares {
  double s, s1, s2, q, q1, q2;
};

Shares shares(double d, const LawParameters& coefficients) {
  const auto [p, a1, a2, a3] = coefficients;
  const double sound = std::max(1.0 - d, 0.0), b = a2, e = a2 * a3;
  return {.s = std::pow(sound, p),
          .s1 = -p * std::pow(sound, p - 1.0),
          .s2 = p * (p - 1.0) * std::pow(sound, p - 2.0),
          .q = a1 * d * (1.0 + d * (b + e * d)),
          .q1 = a1 * (1.0 + d * (2.0 * b + 3.0 * e * d)),
          .q2 = a1 * (2.0 * b + 6.0 * e * d)};
}

// Wu, J. Mech. Phys. Solids 103 (2017) 72, eq. 3.15.
constexpr DegradationLaw rational{
    .name = "rational",
    .description = "g = (1-d)^p / ((1-d)^p + a1 d (1 + a2 d + a2 a3 d^2)), from a softening law",
    .needs_strength = true,
    .g =
        [](double d, const LawParameters& c) {
          const Shares h = shares(d, c);
          return h.s / (h.s + h.q);
        },
    .g_prime =
        [](double d, const LawParameters& c) {
          const Shares h = shares(d, c);
          const double sum = h.s + h.q;
          return (h.s1 * h.q - h.s * h.q1) / (sum * sum);
        },
    .g_second =
        [](double d, const LawParameters& c) {
          const Shares h = shares(d, c);
          const double sum = h.s + h.q, numerator = h.s1 * h.q - h.s * h.q1;
          return (h.s2 * h.q - h.s * h.q2) / (sum * sum) - 2.0 * numerator * (h.s1 + h.q1) / (sum * sum * sum);
        },
};

// Borden, Hughes, Landis, Anvari, Lee, CMAME 312 (2016) 130, eq. 30: g'(0) = -s, so that damage hardly grows before the
// peak.
constexpr LawParameter cubic_parameters[] = {{"s", "1", false, 1e-4}};
constexpr DegradationLaw cubic{
    .name = "cubic",
    .description = "g = s ((1-d)^3 - (1-d)^2) + 3 (1-d)^2 - 2 (1-d)^3; nearly elastic up to the peak (Borden 2016)",
    .needs_strength = false,
    .g =
        [](double d, const LawParameters& p) {
          const double x = 1.0 - d, s = p[0];
          return x * x * (s * (x - 1.0) + 3.0 - 2.0 * x);
        },
    .g_prime =
        [](double d, const LawParameters& p) {
          const double x = 1.0 - d, s = p[0];
          return -x * (s * (3.0 * x - 2.0) + 6.0 * (1.0 - x));
        },
    .g_second =
        [](double d, const LawParameters& p) {
          const double x = 1.0 - d, s = p[0];
          return s * (6.0 * x - 2.0) + 6.0 - 12.0 * x;
        },
    .parameters = cubic_parameters,
};

constexpr DegradationLaw all_degradations[] = {quadratic, cubic, rational};

}  // namespace

Degradation rational_degradation(const RationalCoefficients& c) { return {rational, {c.p, c.a1, c.a2, c.a3}}; }

std::span<const DegradationLaw> degradations() { return all_degradations; }

const DegradationLaw& degradation_law(std::string_view name) {
  return find_by_name(degradations(), name, "degradation function");
}

Degradation degradation(std::string_view name) { return Degradation(degradation_law(name)); }

}  // namespace pfdm
