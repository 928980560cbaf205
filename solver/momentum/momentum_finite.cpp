// Finite strain in the momentum balance (momentum.h): the tensors a and c of cells whose law is linearised.

#include "solver/momentum/acoustic_tensor.h"
#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

namespace pfdm {
namespace {

bool is_positive(const Tensor& Q) {
  return Q(0, 0) > 0.0 && Q(0, 0) * Q(1, 1) - Q(0, 1) * Q(1, 0) > 0.0 && Q.determinant() > 0.0;
}

Tensor with_eigenvalues(const Tensor& Q, const auto& change) {
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(Q);
  const Vector values = eigen.eigenvalues().unaryExpr(change);
  return symmetric_part(eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose());
}

// (h_P A_P^-1 + h_N A_N^-1)^-1
Tensor in_series(const Tensor& A_P, double h_P, const Tensor& A_N, double h_N) {
  return symmetric_part((h_P * A_P.inverse() + h_N * A_N.inverse()).inverse());
}

}  // namespace

void MomentumOperator::set_tangent(CellField<GradientStress> law, const CellField<double>& g, double part) {
  tangent_ = std::move(law);
  stresses_ = CellField<Tensor>(as_size(mesh_.n_cells()));
  gradient_.update(g, part);
  set_face_tensors();
}

CellField<Tensor> MomentumOperator::reconstructed_gradients(const std::vector<Vector>& u) const {
  find_gradients(u);
  return gradients_;
}

// A law that is not polyconvex, or a degraded one, may lose the positive definiteness: what the balance converges to
// stays that of the true stress.
Tensor MomentumOperator::acoustic(Index cell, const Vector& n) const {
  if (!is_finite()) return acoustic_tensor(stiffness_[cell], n);
  constexpr double negligible = 1e-12;
  Tensor Q = symmetric_part(acoustic_tensor(tangent_[cell].A, n));
  if (is_positive(Q)) return Q;
  return with_eigenvalues(Q, [&](double e) { return std::max(std::abs(e), negligible * Q.norm()); });
}

// In polyhedra at finite strain the largest eigenvalue, lambda + 2 mu at small strain, is reduced to the jump's share
// of it, as momentum_jump.cpp does; stretched along n it is smaller, and the share too small.
Tensor MomentumOperator::capped_acoustic(Index cell, const Vector& n) const {
  Tensor Q = acoustic(cell, n);
  if (!is_finite() || jump_share_[cell] == 1.0) return Q;
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(Q, Eigen::EigenvaluesOnly);
  const Vector& e = eigen.eigenvalues();
  const double most = std::max(jump_share_[cell] * e[2], (moderate_lambda + 2.0) * e[1]);
  return e[2] > most ? with_eigenvalues(Q, [&](double value) { return std::min(value, most); }) : Q;
}

// c: the stiffness of both sides in series; between polyhedra that of the capped ones, blended back to the full one
// where the stiffness of the cells differs.
Tensor MomentumOperator::jump_tensor(const Link& link, double h_P, double h_N) const {
  const Tensor Q_P = acoustic(link.P, link.n), Q_N = acoustic(link.N, link.n);
  Tensor full = in_series(Q_P, h_P, Q_N, h_N);
  if (!is_finite() || (jump_share_[link.P] == 1.0 && jump_share_[link.N] == 1.0)) return full;
  const double t_P = Q_P.trace(), t_N = Q_N.trace();
  const double theta = 1.0 - std::min(t_P, t_N) / std::max(t_P, t_N);
  const Tensor small = in_series(capped_acoustic(link.P, link.n), h_P, capped_acoustic(link.N, link.n), h_N);
  return small + theta * (full - small);
}

}  // namespace pfdm
