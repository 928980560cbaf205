#pragma once
// Softening laws sigma(w) of a cohesive crack with the strength ft [Pa] and the toughness Gf [J/m^2], and the rational
// degradation that makes a phase field produce them (Wu, J. Mech. Phys. Solids 103 (2017) 72; Wu, Nguyen, ibid. 119
// (2018) 20):
//
//   g(d) = (1-d)^p / ((1-d)^p + a1 d (1 + a2 d + a2 a3 d^2)),   a1 = 4 E Gf / (pi ell ft^2).
//
// The coefficients follow from the law's initial slope k0 and final opening w_c alone:
//   a2 = 2 (-2 k0 Gf/ft^2)^(2/3) - p - 1/2;   p = 2: 1 + a2 + a2 a3 = (1/2) (w_c ft / (2 Gf))^2;   p > 2: a3 = 0.

#include <span>
#include <string_view>

namespace pfdm {

struct SofteningLaw {
  std::string_view name;
  std::string_view description;
  double initial_slope;                ///< -k0 Gf/ft^2 [-]
  double final_opening;                ///< w_c ft/Gf [-]; infinite for laws with a tail
  double exponent;                     ///< p of the degradation
  double (*traction)(double opening);  ///< sigma/ft against w ft/Gf, both [-]
  double (*slope)(double opening);     ///< its derivative
  double (*work)(double opening);      ///< its integral from 0: 1 in the end
};

std::span<const SofteningLaw> softening_laws();
/// Throws InputError naming those there are.
const SofteningLaw& softening_law(std::string_view name);

/// Coefficients a1, a2, a3 and exponent p of the rational degradation.
struct RationalCoefficients {
  double p = 2.0, a1 = 0.0, a2 = 0.0, a3 = 0.0;
};

/// E [Pa], Gf [J/m^2], ft [Pa], ell [m].
RationalCoefficients rational_coefficients(const SofteningLaw& law, double E, double Gf, double ft, double ell);

/// The largest length for which the law's strength is ft [m]: beyond it damage begins before the stress reaches ft and
/// softens back, a1 < a2 + p + 1/2.
double longest_length(const SofteningLaw& law, double E, double Gf, double ft);

}  // namespace pfdm
