#pragma once
// The two ways in which a run can end badly. Their messages say what, where and what is allowed; main() prints them.

#include <stdexcept>

namespace pfdm {

/// The input is wrong (exit status 2): a key, a unit, a mesh, a patch.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computation could not continue (exit status 1): no convergence at the smallest increment, disk full.
struct ComputationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A model that has no answer at these parameters, as far as it was followed. Whoever tries parameters survives it.
struct NoConvergence : ComputationError {
  using ComputationError::ComputationError;
};

}  // namespace pfdm
