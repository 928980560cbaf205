#pragma once
// Equilibrium at finite strain and fixed damage: Newton's method, each step by FGMRES with the consistent tangent,
// shortened until no sound cell turns inside out and the residual falls.

#include "solver/fracture/cell_stiffness.h"

namespace pfdm {

/// From state.displacement, which the histories belong to, at the load of the state. The momentum balance is left
/// linearised about the result. The residual is the true one; infinite if even the shortest step turns some cell inside
/// out.
Equilibrium solve_finite(const CellStiffness& stiffness, const CellHistories& start,
                         const MomentumSolver::Tolerance& tolerance, MomentumSolver& momentum, FractureState& state);

}  // namespace pfdm
