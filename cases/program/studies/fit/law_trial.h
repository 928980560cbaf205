#pragma once
// Whether another law would explain what a fit leaves.

#include "cases/program/session/terminal/log.h"
#include "cases/program/studies/runs/case_runs.h"
#include "solver/calibration/calibration.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct TriedLaw {
  std::string shown;  ///< what is changed in the case
  double rms = 0.0;   ///< of the residuals, all parameters estimated anew
};

/// Of `laws` the one that leaves least by the linear model about the estimates of `result` (a run each), fitted from
/// these on with a few iterations. `problem_with`: the problem of `result` with another case as its model. Nothing if
/// there is no other law, or if the model converges with none.
std::optional<TriedLaw> best_other_law(const std::vector<CaseVariant>& laws, const FitResult& result,
                                       const std::function<FitProblem(const CaseFile&)>& problem_with,
                                       FitSettings settings, Log& log);

}  // namespace pfdm
