#pragma once
// Closed forms of a bar in tension whose damage localises: first integrals of the one-dimensional problem with
// quadratic degradation (Pham, Marigo, C. R. Mecanique 338 (2010) 191, for AT1; the same integral gives AT2), and with
// the rational one of cohesive cracks.

#include "physics/damage/softening_law.h"

namespace pfdm {

/// One point of a traction-separation law.
struct BarPoint {
  double stress = 0.0;      ///< [Pa]
  double separation = 0.0;  ///< elongation in excess of the far field's strain [m]
};

/// First damage and peak: sqrt(3 E Gc / (8 ell)) [Pa].
double at1_strength(double E, double Gc, double ell);
/// Peak of the homogeneous response, at d = 1/4: (9/16) sqrt(E Gc / (3 ell)) [Pa].
double at2_strength(double E, double Gc, double ell);

/// AT1, softening branch, at the largest damage d_max in (0, 1); the far field is undamaged.
BarPoint at1_softening(double E, double Gc, double ell, double d_max);
/// AT2, softening branch, at the far field's damage D in (0, 1/4]; reversible far field.
BarPoint at2_softening(double E, double Gc, double ell, double d_far);

/// The law that Wu's phase field (PF-CZM) produces, at the largest damage d_max in (0, 1): it does not depend on ell or
/// E, and is the softening law itself for "linear" (Wu, J. Mech. Phys. Solids 103 (2017) 72, eqs. 3.5 and 3.6).
BarPoint pfczm_softening(const SofteningLaw& law, double Gf, double ft, double d_max);

/// Toughness that a uniform cell-centred two-point scheme dissipates over Gc, when one cell of width h breaks.
double at1_discrete_toughness(double h, double ell);  ///< 1 + h^2/(32 ell^2)
double at2_discrete_toughness(double h, double ell);  ///< sqrt(1 + h^2/(4 ell^2))

}  // namespace pfdm
