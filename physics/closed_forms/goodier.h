#pragma once
// A sphere bonded in an infinite matrix under remote uniaxial tension along z (Goodier, J. Appl. Mech. 1 (1933) 39;
// Eshelby, Proc. R. Soc. A 241 (1957) 376). The centre is the origin.

#include "physics/elasticity/elasticity.h"

namespace pfdm {

class Goodier {
 public:
  /// radius [m], remote stress [Pa].
  Goodier(IsotropicElasticity inclusion, IsotropicElasticity matrix, double radius, double stress);

  Vector displacement(const Vector& x) const;  ///< [m]
  Tensor gradient(const Vector& x) const;      ///< du_i/dx_j [-]; at the surface that of the matrix
  Tensor stress(const Vector& x) const;        ///< [Pa]
  /// Traction normal to the interface [Pa] at the polar cosine, n.sigma.n = sigma_h + s P2(cos).
  double interface_normal_traction(double cos_polar_angle) const;

 private:
  bool inside(const Vector& x) const { return x.squaredNorm() < radius_ * radius_; }
  Tensor matrix_gradient(const Vector& x) const;

  IsotropicElasticity inclusion_, matrix_;
  double radius_;
  Tensor deviator_;       // remote strain deviator e
  double remote_swell_;   // remote trace / 3
  double swell_, share_;  // inside: grad u = swell I + share e
  double C_, A_, B_;      // outside: coefficients of the decaying terms
};

}  // namespace pfdm
