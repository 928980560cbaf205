#pragma once
// The linear solvers of the momentum balance: what FGMRES is preconditioned by, the solution with the compact matrix by
// a cycle of multigrid or by its Cholesky factors.

#include "solver/linear/block_matrix.h"
#include "solver/momentum/body/unknowns.h"

#include <memory>
#include <span>
#include <string_view>

namespace pfdm {

class MomentumOperator;

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// Takes this compact matrix of the balance, which has a row for every node, in place of the last one. Throws
  /// ComputationError, with the place, if it is singular.
  virtual void build(const BlockTriplets& matrix, const MomentumOperator& balance) = 0;
  /// z approximates A^-1 r. Vectors beyond the nodes are left alone.
  virtual void apply(const std::vector<Vector>& r, std::vector<Vector>& z) = 0;
};

struct LinearSolver {
  std::string_view name, description;
  std::unique_ptr<Preconditioner> (*make)(const Mesh&, const Unknowns&);  ///< for use while both exist
};

/// The first one is the default.
std::span<const LinearSolver> linear_solvers();
/// Throws InputError for an unknown name.
const LinearSolver& linear_solver(std::string_view name);

/// Whether the automatic choice is direct: on meshes one cell thick (every cell has two faces on the boundary or more)
/// of moderate size.
bool prefers_direct(const Mesh& mesh);

}  // namespace pfdm
