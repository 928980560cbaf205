#pragma once
// Degradation of the energies of a cell at finite strain (finite_cells.h).
//
// Broken cells may stretch without end or turn inside out:
//
// - The functions of J go on as parabolas below J = 0.1: W and its stress are finite for any F.
// - W becomes mu/2 (F:F - 3), a network that keeps nothing but its shear modulus, times g. Its stress g mu F is linear,
//   objective and has a positive definite tangent; at rest it pulls with g mu. (Wang, Lazarov, Sigmund, Jensen, Comput.
//   Methods Appl. Mech. Engrg. 276 (2014) 453, blend to a linear energy likewise, but one that is not objective.) It
//   does so between g = 3e-3 and 1e-4, in nearly incompressible materials between 2e-2 and 9e-4, along a function that
//   keeps the energy convex in d in cells that are stretched to twice their length or more, d > 0.6, with the quadratic
//   degradation; at smaller stretches it is not.
// - Nearly incompressible materials cannot open a crack without moving their surroundings. The part of U that a
//   pressure carries (hyperelastic.h) is lost faster than g, kappa -> g kappa/(1 + kappa/kappa_s (1 - g)^2) with
//   kappa_s = 2.5 mu, mu with all branches: a sound cell loses it as W, a broken one is compressible. (Li, Bouklas,
//   Int. J. Solids Struct. 182-183 (2020) 193, relax it by another power of 1 - d.) What is left of it is not convex in
//   d at small d.
// - What Newton's method cannot bridge of a change of the damage is halved (staggered.cpp).

#include "physics/materials/hyperelastic.h"

#include <string_view>

namespace pfdm {

/// Behaviour of a split at finite strain: a row of the table of those there are.
struct FiniteSplit {
  std::string_view name;
  bool keeps_compression = false;  ///< from the degradation
  bool driven_by_compression = true;
};

/// Throws InputError naming those there are.
const FiniteSplit& finite_split(std::string_view name);

/// A function of the stiffness factor g, and its derivatives.
struct FiniteShare {
  double value = 1.0, slope = 0.0, curvature = 0.0;
};

/// Shares of the energies that a cell with the factor g has: of W_m, of the network's, and of the volumetric one of its
/// pressure.
struct FiniteShares {
  FiniteShare moderate, network, pressure{};
  /// The part of the pressure's slope, and its derivative, by which it is lost as W_m is: without what it is lost
  /// faster.
  struct Slope {
    double slope = 0.0, curvature = 0.0;
  } pressure_as_moderate{};
};

/// The shares in W = g (w W_m + (1 - w) N) + w r c U, w and r being functions of g and N the network's energy. A split
/// that keeps compression adds closure (1 - g) W_c, and keeps this share of c U.
FiniteShares finite_shares(const HyperelasticMaterial& material, double g);

/// Potential of broken cells, mu/2 (F:F - 3), at the displacement gradient H.
PotentialAt network_potential(const HyperelasticMaterial& material, const Tensor& H);

}  // namespace pfdm
