#pragma once
// Bodies with a history (viscoelastic, plastic, endochronic cells) as one solve sees them.

#include "mesh/fields.h"
#include "physics/elasticity/elasticity.h"
#include "physics/elasticity/linear_stress.h"
#include "solver/momentum/body/cell_mechanics.h"

#include <vector>

namespace pfdm {

/// Remainders of earlier volume changes of a relaxing cell that has a pressure, times shear moduli: of the change by
/// the cell's gradient, and of that by the flux through its faces [Pa].
struct VolumeStress {
  double by_gradient = 0.0, by_flux = 0.0;
};

struct HistoryStress {
  /// Linearised stress of every cell, in place of that of its moduli. Empty: there is no history.
  CellField<LinearStress> stress{};
  /// The undamaged moduli that a change of strain meets in the step, and `relaxes` of the cells whose gaps relax; both
  /// empty without any.
  CellField<IsotropicElasticity> sound{};
  CellField<char> relaxes{};
  CellField<VolumeStress> volumes{};  ///< empty without any
  std::vector<GapStress> gaps{};      ///< remainder of earlier gaps, by Mesh::cell_faces; empty without any

  bool any() const { return stress.size() > 0; }
};

}  // namespace pfdm
