#pragma once
// Equilibrium at finite strain and fixed damage: Newton's method, each step by FGMRES with the consistent tangent,
// shortened until the residual falls.

#include "solver/fracture/cells/cell_stiffness.h"

namespace pfdm {

/// From state.displacement, about which the momentum balance has to be linearised, at the load of the state. It is left
/// linearised about the result. The residual is the true one; infinite if no part of a step lowers it.
Equilibrium solve_finite(const CellStiffness& stiffness, const MomentumSolver::Tolerance& tolerance,
                         MomentumSolver& momentum, FractureState& state, Index most_steps = 30);

/// Whether some cell that has kept half of its stiffness or more has nearly turned inside out, where the balance is
/// linearised. Others may (finite_degradation.h).
bool inverts(const MomentumOperator& balance);

}  // namespace pfdm
