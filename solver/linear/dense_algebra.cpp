#include "solver/linear/dense_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace pfdm {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using PivotedQr = Eigen::ColPivHouseholderQR<MatrixXd>;

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) {
  if (A.cols() == 0) return {};  // of which Eigen looks for the largest column
  return PivotedQr(A).solve(b);
}

VectorXd scaled_least_squares(const MatrixXd& A, const VectorXd& b) {
  const VectorXd norms = A.colwise().norm().cwiseMax(1e-300);
  const VectorXd scaled = least_squares(A * norms.cwiseInverse().asDiagonal(), b);
  return scaled.cwiseQuotient(norms);  // A/s (s p) = b: to get p, divide; the report (A4.3, step 4) says multiply
}

MatrixXd upper_triangle(const MatrixXd& A) {
  const Eigen::Index n = A.cols();
  const Eigen::HouseholderQR<MatrixXd> qr(A);
  return qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
}

Eigen::Index rank(const MatrixXd& A, double threshold) {
  PivotedQr qr(A);
  return qr.setThreshold(threshold).rank();
}

VectorXd solve_symmetric(const MatrixXd& A, const VectorXd& b) { return A.ldlt().solve(b); }

MatrixXd inverse_of_symmetric(const MatrixXd& A) { return A.ldlt().solve(MatrixXd::Identity(A.rows(), A.cols())); }

SymmetricModes symmetric_modes(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const MatrixXd& A) { return A.eigenvalues(); }

SingularValues singular_values(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace pfdm
