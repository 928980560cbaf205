#pragma once
// Ogden's hyperelastic model of an incompressible material (Ogden, Proc. R. Soc. Lond. A 326 (1972) 565):
// W = sum_i (mu_i/alpha_i) (l1^alpha_i + l2^alpha_i + l3^alpha_i - 3), in uniaxial stress
// S = sum_i mu_i (l^(alpha_i - 1) - l^(-alpha_i/2 - 1)).

#include <span>

namespace pfdm {

struct OgdenTerm {
  double mu = 0.0;     ///< [Pa]; of the sign of alpha in a material that is stable at any stretch
  double alpha = 1.0;  ///< [-], not 0
};

/// Force per area of the unloaded section at the stretch l > 0, uniaxial stress [Pa].
double nominal_stress(std::span<const OgdenTerm> terms, double stretch);

/// Shear modulus without stretch: sum mu_i alpha_i / 2 [Pa]; Young's modulus is three times that.
double shear_modulus(std::span<const OgdenTerm> terms);

}  // namespace pfdm
