#pragma once
// Damage that grows evenly over a body that softens. Such a state is in equilibrium, and a solver that starts from a
// uniform body stays on it. But it is unstable once the body is longer than a few ell: its energy falls where the
// damage gathers in one place, which it does in a real body (Pham, Amor, Marigo, Maurini, Int. J. Damage Mech. 20
// (2011) 618).

#include "solver/fracture/staggered.h"

#include <string>

namespace pfdm {

/// Watches for it, at prescribed displacements or tractions (a path that is followed past its peak is unstable by
/// intent). States whose damage has a profile, and those that do not soften, take a sum over the cells; others one
/// linear solution, until the warning has been given.
class SpreadDamage {
 public:
  /// The warning after a step from one state to another; empty if there is none, and once it has been given.
  std::string remark(const FractureState& before, const FractureState& now, Staggered& staggered);

 private:
  bool said_ = false;
};

}  // namespace pfdm
