#pragma once
// Motions that the preconditioners of the momentum balance find stiff and the balance does not: the compact matrix has
// two-point differences, which a rigid rotation strains. Stiff inclusions rotate against no more than the soft matrix
// around them, what a cohesive interface cuts off against no more than what is left of that interface, and a body on
// point supports against nothing. These motions are solved for exactly, beside the preconditioner (an additive coarse
// space, as in Nabben, Vuik, SIAM J. Numer. Anal. 42 (2004) 1631):
// z = M^-1 r + R (R^T A R)^-1 R^T r, without what inclusions do to one another, and with half of the second term where
// the preconditioner finds the motion as well.

#include "solver/momentum/solution/preconditioner.h"

namespace pfdm {

/// A solver that adds to `plain`, a row of linear_solvers(), three kinds of motions. These are the rotations of
/// inclusions, which are ten times as stiff as the softest zone or more and touch no boundary, the six rigid motions of
/// parts that split faces cut off from the boundary, and those of a body that three faces hold.
const LinearSolver& with_rigid_modes(const LinearSolver& plain);

}  // namespace pfdm
