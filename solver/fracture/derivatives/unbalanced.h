#pragma once
// What a model leaves unbalanced at a state that need not be one of its own.

#include "solver/fracture/staggered.h"

#include <vector>

namespace pfdm {

struct Unbalanced {
  std::vector<Vector> forces;                ///< of all unknowns of displacement, zero where these are prescribed [N]
  CellField<double> damage;                  ///< minus the left side of the damage equation, over each cell [J]
  std::vector<Vector> boundary_force;        ///< on each boundary face [N]
  std::vector<InterfaceHistory> interfaces;  ///< of the cohesive faces, after the state
};

/// Of the state's displacement, damage and closure at its load, after the histories `before` of the cohesive faces.
/// Leaves the momentum balance of `staggered` linearised there.
Unbalanced unbalanced_of(Staggered& staggered, const FractureState& state, const std::vector<InterfaceHistory>& before);

}  // namespace pfdm
