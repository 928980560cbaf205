#include "solver/vibration/identification/identification_base_noise.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/signals/signals_fourier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double largest_bias = 0.2;  // of coordinates of size one

/// Frequencies of the transform of a conditioned signal that lie in the compared band.
struct Bins {
  Eigen::Index first = 0;
  VectorXd omega;  // [rad/s]
};

Bins compared_bins(const VibrationRecord& r, Eigen::Index n, double rate) {
  const double step = rate / static_cast<double>(n), high = std::min(3.0 * r.band_high, 0.38 * r.rate);
  const auto first = static_cast<Eigen::Index>(std::ceil(0.5 * r.band_low / step));
  const auto last = std::min(static_cast<Eigen::Index>(std::floor(high / step)), n / 2 - 1);
  return {first, 2.0 * std::numbers::pi * step *
                     VectorXd::LinSpaced(last - first + 1, static_cast<double>(first), static_cast<double>(last))};
}

/// Z''/Y''.
VectorXcd response_of(const MassMaterial& model, const VectorXd& omega, double velocity) {
  VectorXcd H(omega.size());
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const double inertia = model.mass * omega[k] * omega[k];
    H[k] = inertia / (complex_stiffness(model, omega[k], velocity) - inertia);
  }
  return H;
}

/// Nonnegative a and b of p = a + b q, where p scatters in proportion to its mean.
ChannelNoise proportional_fit(const VectorXd& p, const VectorXd& q) {
  ChannelNoise noise{.relative = p.mean(), .base = 0.0};
  for (int i = 0; i < 8; ++i) {
    const VectorXd w = (noise.relative + noise.base * q.array()).inverse();
    MatrixXd A(p.size(), 2);
    A.col(0) = w;
    A.col(1) = w.cwiseProduct(q);
    const VectorXd x = non_negative_least_squares(A, w.cwiseProduct(p));
    noise = {.relative = std::max(x[0], 1e-6 * p.mean()), .base = x[1]};
  }
  return noise;
}

}  // namespace

ChannelNoise channel_noise(const MassMaterial& model, const VibrationRecord& record, double crop, double velocity,
                           const VectorXd& residual) {
  const double rate = output_condition(record, crop).rate();
  const Bins bins = compared_bins(record, residual.size(), rate);
  const VectorXd power = fourier(residual).segment(bins.first, bins.omega.size()).cwiseAbs2();
  const double per_hertz = 2.0 / (rate * static_cast<double>(residual.size()));
  const ChannelNoise found = proportional_fit(power, response_of(model, bins.omega, velocity).cwiseAbs2());
  return {.relative = per_hertz * found.relative, .base = per_hertz * found.base};
}

std::optional<VectorXd> base_noise_bias(std::span<const VibrationRecord> records,
                                        const ParameterCoordinates& coordinates, const VectorXd& x,
                                        const VectorXd& weighted, const MatrixXd& jacobian, double crop) {
  constexpr double h = 1e-5;
  const MassMaterial model = coordinates.model(x);
  VectorXd gradient = VectorXd::Zero(x.size());
  Eigen::Index at = 0;
  for (const VibrationRecord& r : records) {
    const Conditioner condition = output_condition(r, crop);
    const Eigen::Index n = condition.n_samples();
    const VectorXd measured = condition(r.relative);
    const double weight = std::sqrt(static_cast<double>(n)) / measured.norm();
    const VectorXd residual = weighted.segment(at, n) / weight;
    at += n;
    if (driving_base(r).swept) continue;
    const double velocity = 0.5 * peak_motion(r).velocity;  // about the amplitude that occurs
    const double density = channel_noise(model, r, crop, velocity, residual).base;
    const Bins bins = compared_bins(r, n, condition.rate());
    const VectorXcd H = response_of(model, bins.omega, velocity);
    // The sum over the samples of the squared response to noise is n times the integral of its density.
    const double scale =
        weight * weight * static_cast<double>(n) * density * (bins.omega[1] - bins.omega[0]) / (2.0 * std::numbers::pi);
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const VectorXd step = h * VectorXd::Unit(x.size(), j);
      const VectorXcd slope = (response_of(coordinates.model(x + step), bins.omega, velocity) -
                               response_of(coordinates.model(x - step), bins.omega, velocity)) /
                              (2.0 * h);
      gradient[j] += scale * H.dot(slope).real();
    }
  }
  if (gradient.isZero(0.0)) return gradient;
  const VectorXd norms = jacobian.colwise().norm().cwiseMax(1e-300);
  const MatrixXd A = jacobian * norms.cwiseInverse().asDiagonal();
  MatrixXd normal = A.transpose() * A;
  normal.diagonal().array() += 1e-8;  // directions that the records do not determine
  const VectorXd bias = -solve_symmetric(normal, gradient.cwiseQuotient(norms)).cwiseQuotient(norms);
  return bias.lpNorm<Eigen::Infinity>() < largest_bias ? std::optional(bias) : std::nullopt;
}

}  // namespace pfdm
