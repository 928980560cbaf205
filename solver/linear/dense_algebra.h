#pragma once
// Dense linear algebra that several parts need, compiled once: Eigen's decompositions of matrices of any size take the
// compiler seconds in each file that names them.

#include <Eigen/Core>

namespace pfdm {

/// The x that minimises |A x - b|, by QR with column pivoting. A: (m, n), m >= n; b: (m).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The same minimum with all columns of A brought to norm one first, for columns of very different size.
Eigen::VectorXd scaled_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// R of A = Q R without pivoting, Q orthogonal. A: (m, n), m >= n; R: (n, n), upper triangular.
Eigen::MatrixXd upper_triangle(const Eigen::MatrixXd& A);

/// Number of pivots of QR with column pivoting above `threshold` times the largest.
Eigen::Index rank(const Eigen::MatrixXd& A, double threshold);

/// x of A x = b, A symmetric and positive or negative semi-definite, by LDL^T. A: (n, n); b: (n).
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The inverse of a symmetric matrix, positive or negative definite, by LDL^T. A, result: (n, n).
Eigen::MatrixXd inverse_of_symmetric(const Eigen::MatrixXd& A);

/// A = vectors diag(values) vectors^T of a symmetric matrix; values ascend, the columns of `vectors` are orthonormal.
/// A: (n, n), of which the lower triangle is read; values: (n); vectors: (n, n).
struct SymmetricModes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricModes symmetric_modes(const Eigen::MatrixXd& A);

/// Eigenvalues of a real matrix that need not be symmetric, in no order. A: (n, n).
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// Singular values in descending order and the right singular vectors, the columns of V: A = U diag(values) V^T.
/// A: (m, n), m >= n; values: (n); V: (n, n).
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
SingularValues singular_values(const Eigen::MatrixXd& A);

}  // namespace pfdm
