#pragma once
// What measured stress and strain tell directly: the plastic strain, the hardening f at every increment of a transient
// (cyclic) response for a known kernel, and a first kernel for a known hardening.

#include "solver/point/endochronic_fit.h"

namespace pfdm {

/// Deviatoric stress and plastic strain at every time of an experiment that follows strains; the others tell nothing
/// here.
struct PlasticHistory {
  std::vector<double> time;  ///< [s]
  std::vector<Mandel> s;     ///< [Pa]
  std::vector<Mandel> plastic_strain;
};

/// Stress components that were not measured are zero. Strains that were not prescribed: shears are elastic, normal ones
/// follow from incompressibility, in equal parts where there are two.
PlasticHistory plastic_history(const IsotropicElasticity& elasticity, const MaterialExperiment& experiment);

struct HardeningPoint {
  double zeta = 0.0;  ///< in the middle of the increment
  double rate = 0.0;  ///< of zeta [1/s]
  double f = 1.0;
  double weight = 0.0;  ///< change of the stress increment with ln f [Pa]
};

/// f of each increment with which the kernel meets the measured increment of stress, in the direction of the plastic
/// strain increment (in tension Eq. A53 of AFRL-RW-EG-TR-2016-088): the root nearest to the one before, since there are
/// several just after reversals. Increments without plastic strain or without a root are left out. `law` gives kernel,
/// elasticity, and f to begin with.
std::vector<HardeningPoint> transient_hardening(const EndochronicLaw& law, const MaterialExperiment& experiment);

/// `n_terms` terms that meet the measured stress best for the law's hardening: stress is linear in C for given alpha,
/// and the positive C on a grid of alpha are gathered into so many groups.
Kernel first_kernel(const EndochronicLaw& law, const std::vector<MaterialExperiment>& experiments, int n_terms);

}  // namespace pfdm
