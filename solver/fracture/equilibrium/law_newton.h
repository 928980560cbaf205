#pragma once
// Equilibrium at small strain and fixed damage where stresses are functions of the strain (energy splits without
// isotropic secant moduli): Newton's method with a line search. The energy is convex, so that the work of the
// unbalanced forces along a step falls until its least energy is reached.

#include "solver/fracture/cells/cell_stiffness.h"

namespace pfdm {

/// From state.displacement, at the load of the state. The balance is left linearised about the result; the residual is
/// the true one.
Equilibrium solve_with_laws(const CellStiffness& stiffness, const MomentumSolver::Tolerance& tolerance,
                            MomentumSolver& momentum, FractureState& state);

}  // namespace pfdm
