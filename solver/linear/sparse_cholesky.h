#pragma once
// Cholesky factorisation of sparse symmetric matrices of 3x3 blocks (CHOLMOD: Chen, Davis, Hager, Rajamanickam, ACM
// Trans. Math. Softw. 35 (2008) 22), simplicial: without BLAS, whose sums depend on its threads. On plane meshes it is
// also faster than the supernodal one.

#include "solver/linear/block_matrix.h"

#include <memory>
#include <optional>

namespace pfdm {

class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Replaces the factor. The ordering is that of the last matrix if the pattern, without entries that are zero, is the
  /// same. A matrix that is singular to working precision is factored with a larger diagonal, by up to `largest_shift`
  /// of itself. Returns the row of blocks at which even that fails (zero, negative or not finite), if any: there is no
  /// factor then.
  std::optional<Index> factor(const BlockTriplets& matrix);
  static constexpr double largest_shift = 1e-2;

  /// x = A^-1 b for a matrix that was factored; b and x have a vector for each row, or more: those stay as they are.
  void solve(const std::vector<Vector>& b, std::vector<Vector>& x);

  Index n_orderings() const;  ///< how many were computed

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pfdm
