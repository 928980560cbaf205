#pragma once
// A linear solver of the momentum balance for bodies that bend, as thin plates. The compact matrix, which multigrid and
// Cholesky factors solve, has two-point differences: a rotation strains it, so that it is too stiff in bending by up to
// (span/thickness)^2, and Krylov's method has to find each long wave by itself. These are solved for beside it, in
// quadratic splines on a grid of boxes about as thick as the plate:
//
//   z = M^-1 r + 1/4 S (S^T K S)^-1 S^T r,
//
// with the elastic energy K of the splines from their strains in the cells and from what they move held faces by (an
// additive auxiliary space: Xu, Computing 56 (1996) 215).

#include "solver/momentum/solution/preconditioner.h"

namespace pfdm {

/// Multigrid beside splines.
const LinearSolver& multigrid_with_splines();

}  // namespace pfdm
