#pragma once
// Whether the forces on the body balance each other, where tolerances could not be made small enough for it.

#include "solver/momentum/body/unknowns.h"

#include <span>
#include <string>

namespace pfdm {

/// Watches a run for steps after which the forces on the surface do not sum to zero.
class UnbalancedForce {
 public:
  /// The warning after a step to this load parameter with these forces on the boundary faces [N], of shape (n_faces -
  /// n_interior_faces), the greatest force of the run [N], and [solver] equilibrium_tolerance; empty if there is none,
  /// and again only when the sum is twice as large. Of sectors about an axis only forces along it count.
  std::string remark(const Unknowns& unknowns, std::span<const Vector> on_faces, double load, double greatest,
                     double tolerance);

 private:
  double said_ = 0.0;  // share of the greatest force
};

}  // namespace pfdm
