#include "solver/dynamics/base_response.h"

#include "physics/error.h"

#include <algorithm>
#include <complex>
#include <utility>

namespace pfdm {
namespace {

using RowMajor = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// y of S y = first e_1, S an upper Hessenberg matrix: elimination with pivots of two rows each, of quadratic cost
/// (Golub, Van Loan, Matrix Computations, Johns Hopkins 2013, section 4.3).
Eigen::VectorXcd solve_hessenberg(RowMajor S, double first) {
  const Eigen::Index m = S.rows();
  Eigen::VectorXcd y = first * Eigen::VectorXcd::Unit(m, 0);
  for (Eigen::Index k = 0; k + 1 < m; ++k) {
    const Eigen::Index rest = m - k;
    if (std::norm(S(k + 1, k)) > std::norm(S(k, k))) {
      S.row(k).tail(rest).swap(S.row(k + 1).tail(rest));
      std::swap(y[k], y[k + 1]);
    }
    const std::complex<double> factor = S(k + 1, k) / S(k, k);
    S.row(k + 1).tail(rest) -= factor * S.row(k).tail(rest);
    y[k + 1] -= factor * y[k];
  }
  for (Eigen::Index k = m - 1; k >= 0; --k) {
    const Eigen::Index rest = m - 1 - k;
    y[k] = (y[k] - S.row(k).tail(rest).transpose().cwiseProduct(y.tail(rest)).sum()) / S(k, k);
  }
  return y;
}

}  // namespace

BaseResponse::BaseResponse(const VibratingBody& body, const Vector& direction, std::span<const Harmonic> wanted,
                           double tolerance, Eigen::Index most_vectors)
    : body_(body),
      direction_(direction),
      space_(body, body.inertial_answer(body.rigid(direction))),
      tolerance_(tolerance),
      most_vectors_(most_vectors) {
  reach(wanted);
}

void BaseResponse::reach(std::span<const Harmonic> wanted) {
  const auto is_reached = [&] {
    return std::ranges::all_of(wanted, [&](const Harmonic& at) { return residual(at) <= tolerance_; });
  };
  while (space_.n_projected() == 0 || !(is_complete_ || is_reached())) {
    if (space_.n_projected() >= most_vectors_)
      throw ComputationError(
          "the response to the base's motion did not converge: the highest frequency is too high "
          "for this mesh");
    for (int k = 0; k < 4 && !is_complete_; ++k) is_complete_ = !space_.extend();
    H_ = space_.projection();
  }
  if (!is_reached())
    throw ComputationError("the response to the base's motion did not converge: no further vector is found");
  const Eigen::Index n_known = mass_moment_.size();
  mass_moment_.conservativeResize(space_.n_projected());
  const Eigen::VectorXd rigid = body_.rigid(direction_);
  for (Eigen::Index j = n_known; j < mass_moment_.size(); ++j) mass_moment_[j] = body_.inner(rigid, space_.vector(j));
}

// Arnoldi's H is an upper Hessenberg matrix.
Eigen::VectorXcd BaseResponse::weights(const Harmonic& at) const {
  RowMajor system = -at.s() * H_.cast<std::complex<double>>();
  system.diagonal().array() += 1.0;
  return solve_hessenberg(std::move(system), space_.start_norm());
}

double BaseResponse::residual(const Harmonic& at) const {
  return std::abs(at.s()) * space_.remainder() * std::abs(weights(at)[H_.rows() - 1]) / space_.start_norm();
}

Eigen::VectorXcd BaseResponse::displacement(const Harmonic& at) const {
  const Eigen::VectorXcd y = -weights(at) / at.factor;
  Eigen::VectorXcd u(body_.size());
  u.real() = space_.combined(y.real());
  u.imag() = space_.combined(y.imag());
  return u;
}

std::complex<double> BaseResponse::transmission(const Harmonic& at, Index unknown) const {
  const Eigen::VectorXcd y = weights(at);
  std::complex<double> sum = 0.0;
  for (Eigen::Index j = 0; j < y.size(); ++j)
    sum += y[j] * direction_.dot(space_.vector(j).segment<3>(3 * Eigen::Index{unknown}));
  return 1.0 + at.s() * sum;
}

double BaseResponse::power(const Harmonic& at) const {
  const std::complex<double> moment =
      -(mass_moment_.cast<std::complex<double>>().transpose() * weights(at)).value() / at.factor;
  return 0.5 * at.omega * moment.imag();
}

CellField<double> strain_power(const VibratingBody& body, const Eigen::VectorXcd& u) {
  using Wanted = MomentumOperator::Wanted;
  const CellMechanics re = body.balance().mechanics(as_vectors(u.real()), Wanted::without_gradient);
  const CellMechanics im = body.balance().mechanics(as_vectors(u.imag()), Wanted::without_gradient);
  CellField<double> power(body.mesh().n_cells());
  for (Index c = 0; c < power.size(); ++c) power[c] = 2.0 * (re.energy[c] + im.energy[c]) / body.mesh().cell_volume[c];
  return power;
}

}  // namespace pfdm
