#pragma once

#include "physics/tensor.h"

#include <functional>
#include <string>

namespace pfdm {

/// Progress of the solution of a step.
struct IterationReport {
  Index step = 0;
  Index iteration = 0;
  double load = 0.0;
  double damage_change = 0.0;
  double energy_change = 0.0;
  Index krylov_iterations = 0;
  bool in_balance = false;  ///< the iteration after this one goes on: it looks for the balance of its interfaces
  std::string remark{};     ///< once of a step that takes long: how far it is, what holds it up, the key to change
};
/// Sees each iteration of a step, and the linear solves within one. It may throw to give the step up.
using IterationWatch = std::function<void(const IterationReport&)>;

}  // namespace pfdm
