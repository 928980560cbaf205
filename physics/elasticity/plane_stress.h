#pragma once
// Plane stress: nothing acts across a thin plate with the normal n, n.sigma.n = 0. The strain across it follows from
// that within it, and what is left is a stiffness within the plate (static condensation). Holds for materials that have
// the plate's normal as an axis of symmetry, so that strain within it makes no shear across it.

#include "physics/elasticity/linear_stress.h"

namespace pfdm {

/// The strain across the plate: n.eps.n = of_strain . eps + initial, eps (Mandel) the strain within the plate [-].
struct StrainAcross {
  Mandel of_strain = Mandel::Zero();
  double initial = 0.0;

  double operator()(const Mandel& strain) const { return of_strain.dot(strain) + initial; }
};

/// n is a unit vector.
StrainAcross strain_across(const LinearStress& material, const Vector& n);

/// The stress by the strain within the plate; across it there is none.
LinearStress plane_stress(const LinearStress& material, const Vector& n);

/// lambda = 2 lambda mu/(lambda + 2 mu) and mu: with no strain across the plate they give the stress within it, and the
/// energy. (The stress that they give across it is none of the material's.)
IsotropicElasticity plane_stress(const IsotropicElasticity& c);

}  // namespace pfdm
