#pragma once
// The matrix of the momentum operator, found by applying it to sums of unit vectors whose images do not overlap
// (Curtis, Powell, Reid, J. Inst. Math. Appl. 13 (1974) 117): it knows nothing of how the operator is made.

#include "solver/momentum/momentum.h"

#include <Eigen/SparseCore>

namespace pfdm {

/// Row and column 3 i + k belong to component k of the operator's unknown i, [N/m]; the second and third component of
/// pressures, and what is prescribed, have ones of the matrix's size on the diagonal and nothing else.
/// Throws ComputationError if an unknown acts further than is tried.
Eigen::SparseMatrix<double> matrix_of(const Mesh& mesh, const Unknowns& unknowns, const MomentumOperator& balance);

}  // namespace pfdm
