#pragma once
// Analytic traction-separation laws fitted to one that was extracted, by solver/calibration.

#include "physics/interfaces/traction_separation.h"
#include "solver/calibration/calibration.h"

#include <string>
#include <vector>

namespace pfdm {

struct CohesiveFit {
  std::string law;
  std::vector<FitParameter> parameters;  ///< strength [Pa], energy [J/m^2], then the law's shape
  FitResult result;
  double rms = 0.0;          ///< of the traction's difference over the separation, over the largest traction [-]
  double largest = 0.0;      ///< difference at a state, over the largest traction [-]
  double information = 0.0;  ///< Bayesian information criterion
};

/// Every law of physics/interfaces/traction_separation.h, the one with the least Bayesian information first. Each state
/// counts by the separation that it stands for; those of a rigid rise, of a thousandth of the largest separation, do
/// not. `separation` [m] and `traction` [Pa] of the states in their order; with less than 10 that count none is fitted.
/// Laws that cannot be fitted are left out.
std::vector<CohesiveFit> fit_laws(const std::vector<double>& separation, const std::vector<double>& traction);

}  // namespace pfdm
