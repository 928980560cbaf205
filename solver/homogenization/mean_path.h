#pragma once
// A path of mean strain and mean stress of a box, one of the two prescribed in each component: the box then moves by
// its mean strain, whose other components are unknowns of the momentum balance (solver/momentum/body/unknowns.h). For
// bodies that are not linear: composites that debond.

#include "physics/elasticity/mandel.h"
#include "solver/homogenization/homogenization.h"

#include <array>
#include <vector>

namespace pfdm {

struct MeanPath {
  std::array<bool, 6> by_stress{};  ///< by component, in the order of component_names: the stress, else the strain
  /// Reached one after the other at the load parameters 1, 2, ..., linearly from zero and from one to the next. Stress
  /// [Pa] or strain, components as those of the tensor.
  std::vector<std::array<double, 6>> points;

  std::array<double, 6> at(double t) const;
};

/// Young's and other moduli of the box as if its stresses were uniform (Reuss): an estimate from below.
IsotropicElasticity reuss_estimate(const Mesh& mesh, const CellField<IsotropicElasticity>& cells);

/// How the box moves by this path. `estimate`: of its stiffness, by which only the effort of the solution changes.
/// Throws InputError for a body that does not fill a box, whose sides do not match, or a loading by the forces on the
/// sides.
BoxMotion motion_along(const MeanPath& path, const Mesh& mesh, const Loading& loading,
                       const IsotropicElasticity& estimate);

}  // namespace pfdm
