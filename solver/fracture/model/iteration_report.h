#pragma once

#include "physics/tensor.h"

#include <functional>

namespace pfdm {

/// Progress of the solution of a step.
struct IterationReport {
  Index step = 0;
  Index iteration = 0;
  double load = 0.0;
  double damage_change = 0.0;
  double energy_change = 0.0;
  Index krylov_iterations = 0;
};
/// Sees each iteration of a step. It may throw to give the step up.
using IterationWatch = std::function<void(const IterationReport&)>;

}  // namespace pfdm
