#pragma once
// Where the descents of a fit start.

#include "solver/calibration/calibration_scale.h"

namespace pfdm {

/// The start, then points at random; or the best of a sample (FitSettings::screened), which `result` keeps. Throws
/// NoConvergence if the model converges at no point of the sample.
std::vector<Eigen::VectorXd> starting_points(const ScaledModel& model, const FitSettings& settings, FitResult& result);

}  // namespace pfdm
