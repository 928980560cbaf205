#pragma once
// Isotropic linear elasticity at small strain: sigma = lambda tr(eps) I + 2 mu eps.

#include "physics/tensor.h"

namespace pfdm {

struct IsotropicElasticity {
  double lambda = 0.0;  ///< first Lame constant [Pa]
  double mu = 0.0;      ///< shear modulus [Pa]

  double bulk_modulus() const { return lambda + 2.0 * mu / 3.0; }                          ///< K [Pa]
  double constrained_modulus() const { return lambda + 2.0 * mu; }                         ///< M, uniaxial strain [Pa]
  double young_modulus() const { return mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu); }  ///< E [Pa]
  double poisson_ratio() const { return 0.5 * lambda / (lambda + mu); }                    ///< nu [-]
  friend bool operator==(const IsotropicElasticity&, const IsotropicElasticity&) = default;
};

/// E > 0 [Pa], -1 < nu < 1/2 [-]; throws InputError otherwise.
IsotropicElasticity from_young_poisson(double E, double nu);

/// sigma [Pa] at the strain eps [-].
inline Tensor stress(const IsotropicElasticity& c, const Tensor& eps) {
  return (c.lambda * eps.trace()) * Tensor::Identity() + (2.0 * c.mu) * eps;
}

/// psi [J/m^3] at the strain eps [-].
inline double energy_density(const IsotropicElasticity& c, const Tensor& eps) {
  const double trace = eps.trace();
  return 0.5 * c.lambda * trace * trace + c.mu * contract(eps, eps);
}

}  // namespace pfdm
