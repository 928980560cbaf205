#pragma once
// The endochronic law with one kernel term C exp(-alpha z) in closed form, as functions of the plastic strain; terms
// add up. Total strain is the plastic strain plus stress over modulus. From the solution of ds = 2 C d eps_p - alpha s
// dz with |d eps_p| = sqrt(3/2) |d eps_p_xx| in tension and |d gamma_p| / sqrt(2) in shear.

#include "physics/point/endochronic.h"

namespace pfdm {

/// Tension from virgin material at constant f: sigma = sqrt(6) (C f/alpha) (1 - exp(-alpha sqrt(3/2) eps_p / f)); 3 C
/// eps_p for alpha = 0 [Pa].
double endochronic_tension(const KernelTerm& term, double f, double plastic_strain);

/// Shear stress likewise: sqrt(2) (C f/alpha) (1 - exp(-alpha gamma_p / (sqrt(2) f))) [Pa].
double endochronic_shear(const KernelTerm& term, double f, double plastic_shear);

/// Peak stress of the steady state under tension and compression of the plastic half amplitude, f = 1:
/// sqrt(6) (C/alpha) tanh(alpha sqrt(3/2) half_amplitude) [Pa].
double endochronic_cyclic_peak(const KernelTerm& term, double half_amplitude);

/// Tension from virgin material with f = 1 + b zeta [Pa].
double endochronic_tension_linear_hardening(const KernelTerm& term, double b, double plastic_strain);

}  // namespace pfdm
