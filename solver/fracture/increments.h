#pragma once
// Increments of the load: their growth and their cuts.

#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/staggered.h"

namespace pfdm {

constexpr double increment_cut = 0.5;    ///< factor of an increment that is tried again
constexpr double load_rounding = 1e-12;  ///< of the load parameter

/// The next load at which a frame is written, or the end.
double next_frame(const LoadingSettings& loading, double load);

/// The increment of the load after a step of this one that converged.
double next_increment(const LoadingSettings& loading, const StaggeredSettings& settings, double increment,
                      const StepOutcome& outcome);

/// Limits of a step of this increment; `planned_increment`: before it was shortened to end on a stop.
StepLimits step_limits(const LoadingSettings& loading, double increment, double planned_increment);

}  // namespace pfdm
