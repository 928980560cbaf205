#pragma once
// Arnoldi's method for A = K^-1 M of a vibrating body: A V = V H + h v e^T with V orthonormal in the product u.M v. Its
// largest eigenvalues, 1/omega^2 of the lowest modes, come first, and with a start K^-1 f the response to f at every
// frequency lies in V (Ruhe, Linear Algebra Appl. 58 (1984) 391; Nour-Omid, Clough, Earthq. Eng. Struct. Dyn. 12 (1984)
// 565). A need not be symmetric.

#include "solver/dynamics/vibrating_body.h"

namespace pfdm {

class KrylovSpace {
 public:
  /// `start` is K^-1 of something, so that it has the displacements of the faces and the pressures that belong to it.
  /// `locked`: orthonormal vectors that A maps into their own span; the space then is one of A without what it makes of
  /// them: its eigenvalues are the others of A.
  KrylovSpace(const VibratingBody& body, Eigen::VectorXd start, std::vector<Eigen::VectorXd> locked = {});

  /// One more vector. Returns false if the space is complete: it holds A of all its vectors.
  bool extend();
  Eigen::Index dimension() const { return static_cast<Eigen::Index>(vectors_.size()); }
  double start_norm() const { return start_norm_; }  ///< in the product u.M v
  /// H, (m, m), of the first m = dimension() - 1 vectors; or of all, if the space is complete.
  Eigen::MatrixXd projection() const;
  double remainder() const { return remainder_; }  ///< h
  Eigen::Index n_projected() const { return projected_; }

  /// sum_j weights_j v_j over the first vectors; weights real.
  Eigen::VectorXd combined(const Eigen::VectorXd& weights) const;
  const Eigen::VectorXd& vector(Eigen::Index j) const { return vectors_[j]; }

 private:
  void take_away_locked(Eigen::VectorXd& v) const;

  const VibratingBody& body_;
  std::vector<Eigen::VectorXd> locked_;
  double start_norm_ = 0.0;
  std::vector<Eigen::VectorXd> vectors_;
  Eigen::MatrixXd H_;
  double remainder_ = 0.0;
  Eigen::Index projected_ = 0;
};

}  // namespace pfdm
