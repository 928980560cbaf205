#pragma once
// Biot stress of hyperelastic materials, T = R^T P with F = R U: symmetric, its principal values the principal forces
// per reference area.

#include "physics/materials/hyperelastic.h"

namespace pfdm {

/// T [Pa] by the displacement gradient H and the first Piola-Kirchhoff stress P there, of an isotropic material.
Tensor biot_stress(const Tensor& H, const Tensor& P);

/// W [J/m^3] where the Biot stress has these principal values [Pa], on the path from the stress-free state along which
/// they grow in proportion. Throws InputError if the path ends before, as at the largest stress of a material.
double energy_at_biot_stress(const HyperelasticMaterial& material, const Vector& principal);

/// F - R with R the rotation of F = R U, in every mode of a stretch of 0.1 or more.
Tensor stretch_part(const Tensor& F);

}  // namespace pfdm
