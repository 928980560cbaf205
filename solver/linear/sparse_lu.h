#pragma once
// LU factors of a sparse matrix, real or complex, that need not be symmetric (UMFPACK: Davis, ACM Trans. Math. Softw.
// 30 (2004) 196), ordered by nested dissection. BLAS is held to one thread: its sums depend on their number.

#include <Eigen/SparseCore>

#include <complex>
#include <memory>

namespace pfdm {

/// Scalar: double or std::complex<double>.
template <class Scalar>
class SparseLu {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Throws ComputationError if the matrix is singular to working precision or the memory does not suffice.
  explicit SparseLu(Matrix matrix);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// x of A x = b, refined until its backward error |b - A x|/(|A| |x| + |b|), of largest entries and the largest sum
  /// of a row of A, is at most 1e-15 (Rigal, Gaches, J. ACM 14 (1967) 543).
  Column solve(const Column& b) const;
  /// Of the factors.
  double n_entries() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

extern template class SparseLu<double>;
extern template class SparseLu<std::complex<double>>;

}  // namespace pfdm
