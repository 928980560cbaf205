#pragma once
// Energy splits psi = psi_plus + psi_minus: only psi_plus is degraded by damage and drives it. (One that is not
// variational has a driving energy psi_plus that is no part of the stored one.) A split here also gives the secant
// moduli of the degraded material, isotropic for the splits below: with them sigma = stress(secant, eps) equals g
// dpsi_plus/deps + dpsi_minus/deps.

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
  bool variational;  ///< psi_plus + psi_minus is the elastic energy, and the stress its slope when degraded
  SplitEnergy (*energy)(const IsotropicElasticity&, const Tensor& eps);
  /// 1 where the strain closes cracks, so that part of the stiffness is kept; 0 where it opens them.
  double (*closure)(const Tensor& eps);
  /// Secant moduli of the material degraded to g (residual stiffness included). With closure(eps) they give the stress
  /// of the law; values between 0 and 1 occur while an iteration settles.
  IsotropicElasticity (*secant)(const IsotropicElasticity&, double g, double closure);
};

std::span<const EnergySplit> energy_splits();
/// Throws InputError naming those there are.
const EnergySplit& energy_split(std::string_view name);

}  // namespace pfdm
