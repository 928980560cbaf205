#pragma once
// Tolerances with which the forces on the parts of a body balance (solver/momentum/solution/force_balance.h), and a
// warning where none are small enough.

#include "solver/fracture/equilibrium/step_outcome.h"
#include "solver/momentum/body/unknowns.h"

#include <optional>
#include <span>
#include <string>

namespace pfdm {

/// With which tolerances a step is tried again: smaller ones that it should have had; or larger ones where it did not
/// converge for those alone, as it did just before, or as all else has. Nothing: it is not. `before`: of its start.
std::optional<ForceBalance> other_tolerances(const StepOutcome& outcome, ForceBalance now, const ForceBalance& before);

/// Watches a run for steps after which the forces on the surface do not sum to zero.
class UnbalancedForce {
 public:
  /// The warning after a step to this load parameter with these forces on the boundary faces [N], of shape (n_faces -
  /// n_interior_faces), and the greatest force of the run [N]; empty if there is none, and again only when the sum is
  /// twice as large. Of sectors about an axis only forces along it count.
  std::string remark(const Unknowns& unknowns, std::span<const Vector> on_faces, double load, double greatest);

 private:
  double said_ = 0.0;  // share of the greatest force
};

}  // namespace pfdm
