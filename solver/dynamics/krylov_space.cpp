#include "solver/dynamics/krylov_space.h"

#include "physics/error.h"

namespace pfdm {

KrylovSpace::KrylovSpace(const VibratingBody& body, Eigen::VectorXd start, std::vector<Eigen::VectorXd> locked)
    : body_(body), locked_(std::move(locked)) {
  take_away_locked(start);
  start_norm_ = std::sqrt(body.inner(start, start));
  if (!(start_norm_ > 0.0)) throw ComputationError("the load on a vibrating body does not move it");
  vectors_.emplace_back(start / start_norm_);
}

void KrylovSpace::take_away_locked(Eigen::VectorXd& v) const {
  for (const Eigen::VectorXd& q : locked_) v -= body_.inner(q, v) * q;
}

// Gram-Schmidt, twice: once leaves the rounding of large components.
bool KrylovSpace::extend() {
  const Eigen::Index m = projected_;
  Eigen::VectorXd next = body_.inertial_answer(vectors_[m]);
  const double size = std::sqrt(body_.inner(next, next));
  H_.conservativeResizeLike(Eigen::MatrixXd::Zero(m + 1, m + 1));
  if (m > 0) H_(m, m - 1) = remainder_;
  for (int pass = 0; pass < 2; ++pass) {
    take_away_locked(next);
    const Eigen::VectorXd weighted = body_.mass().cwiseProduct(next);
    Eigen::VectorXd part(m + 1);
    for (Eigen::Index j = 0; j <= m; ++j) part[j] = vectors_[j].dot(weighted);
    for (Eigen::Index j = 0; j <= m; ++j) next -= part[j] * vectors_[j];
    H_.col(m) += part;
  }
  ++projected_;
  remainder_ = std::sqrt(body_.inner(next, next));
  if (remainder_ <= 1e-12 * size) return false;
  vectors_.emplace_back(next / remainder_);
  return true;
}

Eigen::MatrixXd KrylovSpace::projection() const { return H_; }

Eigen::VectorXd KrylovSpace::combined(const Eigen::VectorXd& weights) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(body_.size());
  for (Eigen::Index j = 0; j < weights.size(); ++j) sum += weights[j] * vectors_[j];
  return sum;
}

}  // namespace pfdm
