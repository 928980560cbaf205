#include "solver/linear/dense_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <memory>

namespace pfdm {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using PivotedQr = Eigen::ColPivHouseholderQR<MatrixXd>;

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) { return least_squares_solver(A)(b); }

std::function<VectorXd(const VectorXd&)> least_squares_solver(const MatrixXd& A) {
  return [qr = std::make_shared<const PivotedQr>(A)](const VectorXd& b) -> VectorXd { return qr->solve(b); };
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

Eigen::VectorXcd eigenvalues(const MatrixXd& A) { return A.eigenvalues(); }

SingularValues singular_values(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace pfdm
