#pragma once
// Linear viscoelasticity at small strain: a generalised Maxwell body whose relaxation functions are Prony series.
// Beside the relaxed elasticity (mu, K) branches of a spring and a dashpot in series carry stress,
//
//   s = 2 mu e + sum 2 mu_i q_i,  q_i' + q_i/tau_i = e',     p = K tr eps + sum K_j r_j,  r_j' + r_j/tau_j = tr eps',
//
// e the deviator of the strain, q_i and r_j the strains of the springs. A step in which the strain changes linearly is
// exact (Simo, Hughes, Computational Inelasticity, 1998, sec. 10.3): with x = dt/tau and phi = (1 - exp(-x))/x
//
//   q = exp(-x) q_n + phi (e - e_n).
//
// In harmonic motion the shear modulus is mu + sum mu_i i w tau_i/(1 + i w tau_i), as dynamic mechanical analysis gives
// it. A term beta exp(-alpha t) of a relaxation kernel is a branch with mu_i = beta and tau_i = 1/alpha.

#include "physics/materials/material.h"
#include "physics/materials/temperature_shift.h"
#include "physics/prony_decay.h"

#include <memory>
#include <optional>
#include <vector>

namespace pfdm {

struct PronyBranch {
  double modulus = 0.0;  ///< of the spring, shear or bulk [Pa]
  double time = 0.0;     ///< relaxation time tau [s]
};

/// The energy that drives damage.
enum class PronyDrive {
  equilibrium,  ///< that of the relaxed elasticity at the whole strain: what is left after any relaxation (Shrimali,
                ///< Lopez-Pamies, Extreme Mech. Lett. 58 (2023) 101944); damage makes heat of what else is stored
  stored,       ///< all that is stored, also in the branches
};

struct PronyLaw {
  IsotropicElasticity relaxed;  ///< at rest for ever [Pa]
  std::vector<PronyBranch> shear{}, bulk{};
  PronyDrive drive = PronyDrive::equilibrium;
  /// Of the times of all branches, which are those at its reference; none: they do not depend on the temperature.
  std::optional<TemperatureShift> shift{};
};

/// Moduli [Pa] that a change of strain meets in a step of this duration [s].
IsotropicElasticity elasticity_over(const PronyLaw& law, double duration);

/// Relaxed moduli and all branches: what a change of strain meets at once [Pa].
IsotropicElasticity instantaneous_elasticity(const PronyLaw& law);

/// Throws InputError unless all moduli and times of the branches are positive.
void require_branches(const PronyLaw& law);

/// The elasticity of the material is the instantaneous one: relaxed moduli and all branches. Its results show
/// viscous_strain, by which the instantaneous stress is less. Throws InputError unless there is a branch, and all
/// moduli and times are positive.
std::shared_ptr<const Material> make_prony(const PronyLaw& law);

}  // namespace pfdm
