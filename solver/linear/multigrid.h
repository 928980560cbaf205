#pragma once
// Aggregation multigrid with a K-cycle (Notay, Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473) for symmetric
// matrices of 3x3 blocks. Smoother: block Gauss-Seidel over fixed, coloured groups of rows; the result does not depend
// on the number of threads. The K-cycle is a nonlinear preconditioner: the outer Krylov method has to be flexible.

#include "solver/linear/aggregation.h"
#include "solver/linear/dense_cholesky.h"

#include <vector>

namespace pfdm {

class Multigrid {
 public:
  explicit Multigrid(BlockMatrix matrix);

  /// One cycle: x approximates A^-1 b.
  void apply(const std::vector<Lane>& b, std::vector<Lane>& x);
  Index n_levels() const { return count_of(levels_); }

 private:
  struct Level {
    BlockMatrix matrix;
    Aggregates aggregates;  // to the next level; unused on the last
    std::vector<std::vector<Index>> groups_by_colour;
    std::vector<Lane> residual, coarse_b, coarse_x;        // of the cycle; coarse ones of the next level's size
    std::vector<Lane> direction[2], image[2], k_residual;  // of the K-cycle on this level
  };

  void set_up_work_space();
  void factor_coarsest();
  void cycle(std::size_t level, const std::vector<Lane>& b, std::vector<Lane>& x);
  void k_cycle(std::size_t level, const std::vector<Lane>& b, std::vector<Lane>& x);
  void solve_coarsest(const std::vector<Lane>& b, std::vector<Lane>& x) const;

  std::vector<Level> levels_;
  DenseCholesky coarsest_;
};

}  // namespace pfdm
