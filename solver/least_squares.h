#pragma once
// Dense linear algebra that several parts need, compiled once: Eigen's decompositions of matrices of any size take the
// compiler seconds in each file that names them.

#include <Eigen/Core>

namespace pfdm {

/// The x that minimises |A x - b|, by QR with column pivoting. A: (m, n), m >= n; b: (m).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Singular values in descending order and the right singular vectors, the columns of V: A = U diag(values) V^T.
/// A: (m, n), m >= n; values: (n); V: (n, n).
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
SingularValues singular_values(const Eigen::MatrixXd& A);

}  // namespace pfdm
