#pragma once
// Symmetric systems of one unknown per cell, as two-point fluxes make them: row i of the matrix is
//
//   (A x)_i = D_i x_i - sum_j c_ij x_j,  c_ij = c_ji >= 0,
//
// solved by conjugate gradients. The preconditioner is an incomplete Cholesky factorisation with the pattern of the
// matrix and only its diagonal changed (Meijerink, van der Vorst, Math. Comput. 31 (1977) 148), within fixed blocks of
// rows, so that results do not depend on the number of threads.

#include "mesh/fields.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfdm {

/// The off-diagonal coefficients c_ij.
class SymmetricCoupling {
 public:
  struct Pair {
    Index i, j;
    double coefficient;
  };
  SymmetricCoupling(Index n, std::span<const Pair> pairs);

  Index n() const { return count_of(rows_); }
  double total(Index row) const { return total_[row]; }  ///< sum of c_ij over j
  /// Sum of c_ij x_j over j.
  double times(Index row, const double* x) const {
    const Row& r = rows_[row];
    double sum = 0.0;
    for (auto k = r.begin; k < r.end; ++k) sum += coefficients_[k] * x[columns_[k]];
    return sum;
  }
  /// The j of a row, ascending.
  std::span<const std::int32_t> columns(Index row) const {
    const Row& r = rows_[row];
    return {columns_.data() + r.begin, columns_.data() + r.end};
  }

 private:
  friend class ConjugateGradients;
  // Columns that one incomplete factorisation couples are [below, diagonal) before the row and [diagonal, above) after.
  struct Row {
    std::int32_t begin, below, diagonal, above, end;
  };
  std::vector<Row> rows_;
  std::vector<std::int32_t> columns_;
  std::vector<double> coefficients_;
  std::vector<double> total_;
};

class ConjugateGradients {
 public:
  using Held = std::vector<signed char>;  ///< nonzero for rows whose x is held at zero

  /// Must not outlive the coupling.
  explicit ConjugateGradients(const SymmetricCoupling& coupling) : coupling_(coupling) {}

  struct Tolerance {
    double reduction = 5e-4;  ///< of the largest |r_i/D_i|
    double least = 1e-11;     ///< |r_i/D_i| that is small enough anyhow
    Index most_iterations = 500;
  };
  /// Adds to x, zero in the held rows, so that r, given as b - A x, falls; r is then the residual. All of size n.
  /// Returns the number of iterations.
  Index solve(const std::vector<double>& diagonal, const Held& held, const Tolerance& tolerance, std::vector<double>& r,
              std::vector<double>& x);

 private:
  void factor(const std::vector<double>& diagonal, const Held& held);
  double precondition(const std::vector<double>& r, std::vector<double>& z) const;

  const SymmetricCoupling& coupling_;
  std::vector<double> pivots_;  // inverted; zero in held rows
};

}  // namespace pfdm
