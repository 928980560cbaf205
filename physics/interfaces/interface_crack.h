#pragma once
// The field around the tip of a crack between two half-planes (Rice, J. Appl. Mech. 55 (1988) 98; Hutchinson, Suo, Adv.
// Appl. Mech. 29 (1992) 63), plane strain or plane stress. The crack is the line along < 0, across = 0. Ahead of it
//
//   s_yy + i s_xy = (K1 + i K2) (r/L)^(i eps) / sqrt(2 pi r),
//   eps = ln[(k_1/mu_1 + 1/mu_2)/(k_2/mu_2 + 1/mu_1)] / (2 pi),
//
// with k = 3 - 4 nu or (3 - nu)/(1 + nu), 1 the upper material (across > 0), L a reference length: K1 and K2 are those
// "at L", and the phase angle at L is atan2(K2, K1). In one material eps = 0, L does not matter and K1, K2 are K_I,
// K_II.

#include "physics/elasticity/elasticity.h"

#include <complex>

namespace pfdm {

struct InterfaceCrack {
  IsotropicElasticity upper, lower;
  bool plane_stress = false;
  double reference_length = 1.0;  ///< L [m]

  double oscillation() const;  ///< eps [-]
  /// H of G = (K1^2 + K2^2)/H [Pa]: that of one material is E/(1 - nu^2), or E in plane stress.
  double modulus() const;
};

struct NearField {
  std::complex<double> slope;                 ///< derivative along the crack of u_x + i u_y [-]
  double s_xx = 0.0, s_yy = 0.0, s_xy = 0.0;  ///< [Pa]
};

/// Field at a place ahead of the tip and beside it [m], K = K1 + i K2 [Pa m^1/2].
NearField near_field(const InterfaceCrack& crack, double along, double across, std::complex<double> K);

}  // namespace pfdm
