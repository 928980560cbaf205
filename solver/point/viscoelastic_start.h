#pragma once
// Where a fit of Prony branches starts. Stresses and complex moduli are linear in the moduli of branches whose times
// are given: non-negative least squares find them. Measured strains of creep take the place of the strains followed.

#include "solver/point/viscoelastic_fit.h"

#include <span>
#include <vector>

namespace pfdm {

/// `n` times over a window, evenly on the logarithmic scale, its ends among them; of one its middle.
std::vector<double> spread_times(const TimeWindow& window, int n);

/// The law with branches of those of the times whose moduli come out positive, and the relaxed modulus that goes with
/// them, or that of `law` where it holds. In tension as if Poisson's ratio were constant. `deviations`: of each
/// measured value.
PronyLaw law_of_times(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                      std::span<const double> deviations, std::span<const double> times);

/// The law with as many branches: those of a fine grid of times, neighbours joined, near ones joined further or small
/// ones added in the widest gaps.
PronyLaw law_of_branches(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                         std::span<const double> deviations, int n);

/// The law with constants of its temperature shift with which many branches meet the data best, looked for about a
/// third to three times the given ones: fits of few branches do not find them from afar.
PronyLaw law_of_shift(const PronyLaw& law, bool holds_relaxed, const ViscoelasticExperiments& experiments,
                      std::span<const double> deviations);

/// Laws with one branch less: the nearest two joined; the one with the smallest modulus left out.
std::vector<PronyLaw> with_one_less(const PronyLaw& law);

/// The law with one more branch, a small one in the widest gap of its times within the window.
PronyLaw with_one_more(const PronyLaw& law, const TimeWindow& window);

}  // namespace pfdm
