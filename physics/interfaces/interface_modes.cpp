// Rules of mixed mode: what strength and toughness are at a mode mixity B.
#include "physics/interfaces/interface_law.h"

#include <cmath>

namespace pfdm {
namespace {

ModeMixture benzeggagh_kenane(const InterfaceStrength& s, double B, double eta) {
  const double part = std::pow(B, eta), slope = eta * std::pow(B, eta - 1.0);
  const double more = s.shear_strength * s.shear_strength - s.strength * s.strength;
  const double strength = std::sqrt(s.strength * s.strength + more * part);
  return {.strength = strength,
          .toughness = s.toughness + (s.shear_toughness - s.toughness) * part,
          .strength_by_B = 0.5 * more * slope / strength,
          .toughness_by_B = (s.shear_toughness - s.toughness) * slope};
}

ModeMixture power_law(const InterfaceStrength& s, double B, double eta) {
  const double opening = (1.0 - B) / s.toughness, shear = B / s.shear_toughness;
  const double toughness = std::pow(std::pow(opening, eta) + std::pow(shear, eta), -1.0 / eta);
  const double slope = std::pow(shear, eta - 1.0) / s.shear_toughness - std::pow(opening, eta - 1.0) / s.toughness;
  const double n = 1.0 / (s.strength * s.strength), t = 1.0 / (s.shear_strength * s.shear_strength);
  const double strength = 1.0 / std::sqrt((1.0 - B) * n + B * t);
  return {.strength = strength,
          .toughness = toughness,
          .strength_by_B = -0.5 * strength * strength * strength * (t - n),
          .toughness_by_B = -std::pow(toughness, 1.0 + eta) * slope};
}

constexpr std::string_view potential_law = "xu_needleman";  // the law and the rule

constexpr MixedMode modes[] = {
    {.name = "camacho_ortiz",
     .description = "equivalent separation; shear_ratio beta: shear strength over strength, one toughness",
     .at = nullptr},
    {.name = "equal_stiffness",
     .description = "one stiffness; shear_ratio beta: shear strength over strength, beta^2: toughness likewise",
     .at = nullptr,
     .keeps_stiffness = true},
    {.name = "benzeggagh_kenane",
     .description = "Gc = G_n + (G_s - G_n) B^exponent; shear_strength, shear_toughness, exponent",
     .at = benzeggagh_kenane},
    {.name = "power_law",
     .description = "((1-B)/G_n)^exponent + (B/G_s)^exponent = Gc^-exponent; the same keys",
     .at = power_law},
    {.name = potential_law,
     .description =
         "potential of Xu and Needleman, q = shear_toughness/toughness, r = 0; shear_strength, shear_toughness",
     .at = nullptr,
     .is_potential = true},
};

}  // namespace

std::span<const MixedMode> mixed_modes() { return modes; }

bool MixedMode::suits(const TractionSeparationLaw& law) const {
  if (is_potential) return law.name == potential_law;
  return at == nullptr || law.has_rise();
}

}  // namespace pfdm
