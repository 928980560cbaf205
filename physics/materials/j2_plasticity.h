#pragma once
// J2 (von Mises) plasticity at small strain with linear isotropic and kinematic hardening, rate-independent (Simo,
// Hughes, Computational Inelasticity, 1998, secs. 2.3.2 and 3.3.1): with s the stress deviator and p the equivalent
// plastic strain,
//
//   |s - q| <= sqrt(2/3) (Y + K p),   d eps_p = dp sqrt(3/2) n,   q = (2/3) H eps_p,   n = (s - q)/|s - q|.

#include "physics/materials/material.h"

#include <memory>

namespace pfdm {

struct J2Parameters {
  double yield_stress = 0.0;         ///< Y in tension [Pa]
  double isotropic_hardening = 0.0;  ///< K, slope of the yield stress by the equivalent plastic strain [Pa]
  double kinematic_hardening = 0.0;  ///< H [Pa]
};

/// Throws InputError unless Y > 0, K >= 0 and H >= 0. Its results show plastic_strain and equivalent_plastic_strain.
std::shared_ptr<const Material> make_j2_plasticity(const IsotropicElasticity& elasticity, const J2Parameters& law);

}  // namespace pfdm
