#pragma once
// Stiffness matrices in few numbers: the closest isotropic moduli, and the distance from them. Bounds within which the
// moduli of an isotropic composite lie.

#include "physics/elasticity/mandel.h"

#include <span>
#include <string_view>

namespace pfdm {

/// The isotropic stiffness closest to C in the Frobenius norm: 3K = C :: J, 10 G = C :: (1 - J), J the volumetric
/// projector (Browaeys, Chevrot, Geophys. J. Int. 159 (2004) 667, eq. A7).
IsotropicElasticity closest_isotropic(const MandelMatrix& C);

/// |C - C_iso| / |C|, of the closest isotropic one [-].
double anisotropy(const MandelMatrix& C);

/// A^U = 5 G_V/G_R + K_V/K_R - 6 (Ranganathan, Ostoja-Starzewski, PRL 101 (2008) 055504, eq. 7); zero if isotropic.
double universal_anisotropy(const MandelMatrix& C);

/// |C - C^T| / |C| [-].
double asymmetry(const MandelMatrix& C);

/// C_ijkl in the order of component_names [Pa], without Mandel's factors: sigma = C (eps_xx ... 2 eps_xy).
MandelMatrix voigt_stiffness(const MandelMatrix& C);
/// Compliance in the order of component_names [1/Pa], for engineering shear strains.
MandelMatrix voigt_compliance(const MandelMatrix& C);

struct Phase {
  double fraction = 0.0;  ///< of the volume
  IsotropicElasticity elasticity;
};

struct ModulusBounds {
  double bulk_lower = 0.0, bulk_upper = 0.0;    ///< [Pa]
  double shear_lower = 0.0, shear_upper = 0.0;  ///< [Pa]
};

/// A pair of bounds on K and G of an isotropic composite of isotropic phases whose fractions sum to 1.
struct BoundPair {
  std::string_view name;
  ModulusBounds (*of)(std::span<const Phase> phases);
};
/// Reuss and Voigt: sums of the compliances and of the stiffnesses.
ModulusBounds reuss_voigt(std::span<const Phase> phases);
/// Hashin and Shtrikman, J. Mech. Phys. Solids 11 (1963) 127, in Walpole's form for any number of phases:
/// K = (sum c / (K_i + z))^-1 - z, z = 4/3 G; G = (sum c / (G_i + y))^-1 - y, y = G/6 (9K + 8G) / (K + 2G), at the
/// least and the largest moduli. For two phases the bound by the matrix's moduli is Mori and Tanaka's estimate for
/// spheres.
ModulusBounds hashin_shtrikman(std::span<const Phase> phases);

}  // namespace pfdm
