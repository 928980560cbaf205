#pragma once
// Work and potential of the loads on a body.

#include "solver/fracture/model/state.h"
#include "solver/momentum/momentum.h"

#include <vector>

namespace pfdm {

/// Potential of tractions and body forces at the load of the state, energy of elastic foundations included [J].
double potential_of_loads(const MomentumOperator& balance, const FractureState& state);

/// Where the loads have taken a body.
struct LoadedBody {
  double load = 0.0;                        ///< parameter
  const std::vector<Vector>& force;         ///< on the boundary faces [N]
  const std::vector<Vector>& displacement;  ///< of the unknowns [m]
};
/// Work of the boundary forces and of the body forces from a state to there [J], by the trapezoidal rule.
double work_of_loads(const Mesh& mesh, const Unknowns& unknowns, const FractureState& from, const LoadedBody& to);

/// Work of the tractions, and of body forces on parts that fall: prescribed displacements, which move or hold the other
/// parts, bear theirs [J].
double work_of_free_loads(const MomentumOperator& balance, const Unknowns& unknowns, const FractureState& state);

/// What the work of eigenstrains follows from.
struct FreeStrained {
  CellField<Mandel> moment;       ///< CellStiffness::eigenstrain_moments [J]
  CellField<Mandel> eigenstrain;  ///< [-]; empty: none
};
/// Energy that eigenstrains supply from one state to the other [J].
double eigenstrain_work(const FreeStrained& from, const FreeStrained& to);

}  // namespace pfdm
