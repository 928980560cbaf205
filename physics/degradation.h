#pragma once
// Degradation functions g(d): how much of the tensile energy a damaged material keeps. g(0) = 1, g(1) = 0; the
// residual stiffness k enters in one place, g_k = (1 - k) g + k.

#include <span>
#include <string_view>

namespace pfdm {

struct Degradation {
  std::string_view name;
  std::string_view description;
  double (*g)(double d);
  double (*g_prime)(double d);
  double (*g_second)(double d);
};

std::span<const Degradation> degradations();
/// Throws InputError naming those there are.
const Degradation& degradation(std::string_view name);

}  // namespace pfdm
