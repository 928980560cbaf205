#pragma once
// Endochronic plasticity without a yield surface (Valanis 1971; Watanabe, Atluri, Int. J. Plasticity 2 (1986) 37):
// isotropic, small strain, plastically incompressible.
//
//   s = 2 int_0^z rho(z - z') (d eps_p / dz') dz',   rho(z) = sum_r C_r exp(-alpha_r z)
//   dz = dzeta / f(zeta, zeta_dot),   dzeta = |d eps_p| (Frobenius),   sigma = s + K tr(eps) I,   s = 2 mu (e - eps_p)
//
// Each term of the kernel keeps its own stress s_r, with ds_r = 2 C_r d eps_p - alpha_r s_r dz; their sum is s. A step
// takes d eps_p / dz as constant, which integrates the terms exactly, and f at zeta + beta dzeta: second order for
// beta = 1/2. |d eps_p| is then the root of one scalar equation that always has a bracket.

#include "physics/elasticity/mandel.h"
#include "physics/point/hardening.h"

#include <vector>

namespace pfdm {

struct KernelTerm {
  double C = 0.0;      ///< [Pa]
  double alpha = 0.0;  ///< [-]; 0: linear kinematic hardening
  friend bool operator==(const KernelTerm&, const KernelTerm&) = default;
};
using Kernel = std::vector<KernelTerm>;

struct EndochronicLaw {
  IsotropicElasticity elasticity;
  Kernel kernel;
  Hardening hardening;
  double beta = 0.5;  ///< place within the step where f is taken, 0 to 1
};

/// Throws InputError if the law makes no sense: moduli that are not positive, no term, beta outside [0, 1].
void check(const EndochronicLaw& law);

struct EndochronicState {
  Mandel strain = Mandel::Zero();
  Mandel plastic_strain = Mandel::Zero();
  std::vector<Mandel> s;     ///< deviatoric stress of each kernel term [Pa]
  double z = 0.0;            ///< intrinsic time [-]
  double zeta = 0.0;         ///< length of the plastic strain path [-]
  double dissipation = 0.0;  ///< heat per volume so far [J/m^3]
};

EndochronicState virgin_state(const EndochronicLaw& law);

/// sigma [Pa]
Mandel stress(const EndochronicLaw& law, const EndochronicState& state);

/// Energy per volume that the terms of the kernel store, |s_r|^2 / (4 C_r) each [J/m^3].
double kernel_energy(const EndochronicLaw& law, const EndochronicState& state);

/// Recoverable energy per volume: of elastic strain and of the kernel [J/m^3].
double free_energy(const EndochronicLaw& law, const EndochronicState& state);

/// |sum_r s_r - 2 mu (e - eps_p)|, which is zero but for rounding [Pa].
double invariant_error(const EndochronicLaw& law, const EndochronicState& state);

/// Norm of the deviatoric stress that f(zeta, rate) allows at most, 2 f sum_r C_r / alpha_r; infinite if an alpha_r is
/// zero [Pa].
double saturation_radius(const EndochronicLaw& law, double zeta, double rate);

struct EndochronicUpdate {
  EndochronicState state;
  Mandel stress;         ///< at the end of the step [Pa]
  MandelMatrix tangent;  ///< d stress / d strain increment, consistent with the step; not symmetric [Pa]
  int iterations = 0;
  double residual = 0.0;  ///< of the scalar equation, relative
  bool converged = false;
};

/// Behaviour of a stress above the stress at rest of a law that depends on the rate, at constant strain. The equations
/// of the step have two solutions: one without plastic strain, and the one that strain rates lead to as they fall to
/// zero. With the latter, a solver for the strain has to know where it may begin (solver/point/rest_flow.h).
enum class AtConstantStrain { stays, relaxes };

/// A step of `strain_increment` in the time dt [s], which only laws that depend on the rate look at. Not converged only
/// if the input is not finite (or dt is not positive where the rate matters).
EndochronicUpdate update(const EndochronicLaw& law, const EndochronicState& state, const Mandel& strain_increment,
                         double dt, AtConstantStrain at_constant_strain = AtConstantStrain::stays);

/// A step whose path grows by a given dzeta, linear in the strain: d eps_p = (mu de + shift) / stiffness. It is a step
/// of the law where |mu de + shift| = stiffness dzeta.
struct StepOfPath {
  Mandel shift;            ///< 1/2 sum s_r (1 - exp(-alpha_r dz)) [Pa]
  double stiffness = 0.0;  ///< mu + sum C_r phi1(alpha_r dz) [Pa]
};
StepOfPath step_of_path(const EndochronicLaw& law, const EndochronicState& state, double dzeta, double dt);

}  // namespace pfdm
