#pragma once
// Whether the forces on the body balance each other. Residuals are relative to the forces that boundary displacements
// would take if nothing gave way: where a stiff part is moved and a soft one carries it, these are those of the stiff
// one, and what is small against them need not be small against the forces that act.

#include "solver/momentum/body/unknowns.h"

#include <span>
#include <string>

namespace pfdm {

/// Watches a run for steps after which the forces on the surface do not sum to zero.
class UnbalancedForce {
 public:
  /// The warning after a step to this load parameter with these forces on the boundary faces [N], of shape (n_faces -
  /// n_interior_faces), and [solver] equilibrium_tolerance; empty if there is none, and again only when the sum is
  /// twice as large against the greatest forces of the run. Of sectors about an axis only forces along it count.
  std::string remark(const Unknowns& unknowns, std::span<const Vector> on_faces, double load, double tolerance);

 private:
  double greatest_ = 0.0;  // half the sum of the faces' forces, so far [N]
  double said_ = 0.0;      // share of it
};

}  // namespace pfdm
