#include "physics/point/ogden.h"

#include <cmath>

namespace pfdm {

double nominal_stress(std::span<const OgdenTerm> terms, double stretch) {
  double stress = 0.0;
  for (const auto& [mu, alpha] : terms)
    stress += mu * (std::pow(stretch, alpha - 1.0) - std::pow(stretch, -0.5 * alpha - 1.0));
  return stress;
}

double shear_modulus(std::span<const OgdenTerm> terms) {
  double modulus = 0.0;
  for (const auto& [mu, alpha] : terms) modulus += 0.5 * mu * alpha;
  return modulus;
}

}  // namespace pfdm
