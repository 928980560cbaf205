#include "physics/degradation.h"

#include "physics/registry.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr Degradation quadratic{
    .name = "quadratic",
    .description = "g = (1 - d)^2",
    .needs_strength = false,
    .g = [](double d, const RationalCoefficients&) { return (1.0 - d) * (1.0 - d); },
    .g_prime = [](double d, const RationalCoefficients&) { return -2.0 * (1.0 - d); },
    .g_second = [](double, const RationalCoefficients&) { return 2.0; },
};

// What is left, s = (1-d)^p, and what is lost, q = a1 d (1 + a2 d + a2 a3 d^2), with their derivatives: g = s/(s+q).
struct Shares {
  double s, s1, s2, q, q1, q2;
};

Shares shares(double d, const RationalCoefficients& c) {
  const double sound = std::max(1.0 - d, 0.0), b = c.a2, e = c.a2 * c.a3;
  return {.s = std::pow(sound, c.p),
          .s1 = -c.p * std::pow(sound, c.p - 1.0),
          .s2 = c.p * (c.p - 1.0) * std::pow(sound, c.p - 2.0),
          .q = c.a1 * d * (1.0 + d * (b + e * d)),
          .q1 = c.a1 * (1.0 + d * (2.0 * b + 3.0 * e * d)),
          .q2 = c.a1 * (2.0 * b + 6.0 * e * d)};
}

// Wu, J. Mech. Phys. Solids 103 (2017) 72, eq. 3.15.
constexpr Degradation rational{
    .name = "rational",
    .description = "g = (1-d)^p / ((1-d)^p + a1 d (1 + a2 d + a2 a3 d^2)), from a softening law",
    .needs_strength = true,
    .g =
        [](double d, const RationalCoefficients& c) {
          const Shares h = shares(d, c);
          return h.s / (h.s + h.q);
        },
    .g_prime =
        [](double d, const RationalCoefficients& c) {
          const Shares h = shares(d, c);
          const double sum = h.s + h.q;
          return (h.s1 * h.q - h.s * h.q1) / (sum * sum);
        },
    .g_second =
        [](double d, const RationalCoefficients& c) {
          const Shares h = shares(d, c);
          const double sum = h.s + h.q, numerator = h.s1 * h.q - h.s * h.q1;
          return (h.s2 * h.q - h.s * h.q2) / (sum * sum) - 2.0 * numerator * (h.s1 + h.q1) / (sum * sum * sum);
        },
};

constexpr Degradation table[] = {quadratic, rational};

}  // namespace

std::span<const Degradation> degradations() { return table; }

const Degradation& degradation(std::string_view name) {
  return find_by_name(degradations(), name, "degradation function");
}

}  // namespace pfdm
