#pragma once
// Energy splits psi = psi_plus + psi_minus: only psi_plus is degraded by damage and drives it. A split here also gives
// the secant moduli of the degraded material, isotropic for the splits below: with them
// sigma = stress(secant, eps) equals g dpsi_plus/deps + dpsi_minus/deps.

#include "physics/elasticity.h"

#include <span>
#include <string_view>

namespace pfdm {

struct SplitEnergy {
  double psi_plus = 0.0;   ///< [J/m^3]
  double psi_minus = 0.0;  ///< [J/m^3]
};

struct EnergySplit {
  std::string_view name;
  std::string_view description;
  SplitEnergy (*energy)(const IsotropicElasticity&, const Tensor& eps);
  /// Secant moduli of the material degraded to g (residual stiffness included) at the strain eps.
  IsotropicElasticity (*secant)(const IsotropicElasticity&, double g, const Tensor& eps);
  bool secant_depends_on_strain;
};

std::span<const EnergySplit> energy_splits();
/// Throws InputError naming those there are.
const EnergySplit& energy_split(std::string_view name);

}  // namespace pfdm
