#pragma once
// Degradation functions g(d): how much of the tensile energy a damaged material keeps. g(0) = 1, g(1) = 0; the
// residual stiffness k enters in one place, g_k = (1 - k) g + k.

#include "physics/softening_law.h"

#include <span>
#include <string_view>

namespace pfdm {

struct Degradation {
  std::string_view name;
  std::string_view description;
  bool needs_strength;  ///< takes its coefficients from a softening law, a strength and a toughness
  double (*g)(double d, const RationalCoefficients& c);
  double (*g_prime)(double d, const RationalCoefficients& c);
  double (*g_second)(double d, const RationalCoefficients& c);
};

std::span<const Degradation> degradations();
/// Throws InputError naming those there are.
const Degradation& degradation(std::string_view name);

}  // namespace pfdm
