#pragma once
// Cholesky factors of a dense symmetric matrix. Eigen's and LAPACK's add in an order that depends
// on the processor's vectors and caches; here each entry is reduced by one column after the other.

#include "mesh/fields.h"

#include <vector>

namespace pfdm {

class DenseCholesky {
 public:
  /// Factors the n x n matrix whose lower triangle stands in `columns`, one column of n numbers after the other. False
  /// where it is not positive definite.
  bool compute(Index n, std::vector<double> columns);

  /// Replaces the n numbers b by A^-1 b.
  void solve(std::vector<double>& b) const;

 private:
  const double* column(Index k) const { return factor_.data() + static_cast<std::size_t>(k) * as_size(n_); }
  double* column(Index k) { return factor_.data() + static_cast<std::size_t>(k) * as_size(n_); }
  bool factor_panel(Index first, Index end);
  void reduce_behind(Index first, Index end);

  Index n_ = 0;
  std::vector<double> factor_;
};

}  // namespace pfdm
