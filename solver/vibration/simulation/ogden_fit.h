#pragma once
// Ogden's model from the stiffness polynomial of a sample: the terms whose force on a bar in uniaxial stress is nearest
// to k(z).

#include "physics/point/ogden.h"

#include <span>
#include <vector>

namespace pfdm {

struct OgdenFit {
  std::vector<OgdenTerm> terms;
  double largest_displacement = 0.0;  ///< where it was fitted, to both sides [m]
  double relative_misfit = 0.0;       ///< norm of the force's difference over that of k(z)
};

/// `stiffness`: k_1, k_2 ... [N/m^i], force over elongation; length [m] and area [m^2] of the bar when k(z) = 0. mu and
/// alpha of a term have the same sign, so that the material is stable; terms that would not improve the fit are left
/// out. Throws InputError if the displacement is not less than the length, or if no stable material has such a
/// stiffness.
OgdenFit fit_ogden(std::span<const double> stiffness, double length, double area, double largest_displacement,
                   int n_terms);

}  // namespace pfdm
