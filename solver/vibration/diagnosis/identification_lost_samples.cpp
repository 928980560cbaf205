#include "solver/vibration/diagnosis/identification_lost_samples.h"

#include "solver/linear/dense_algebra.h"
#include "solver/vibration/signals/signals_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index n_stretches = 40;
constexpr int most_lost = 50;  // samples
// The slow offset of a sample with a quadratic stiffness is lost in integration: a third of the base can stay.
constexpr double less = 0.7;

/// z'', z', z ... z^N within the band, columns of norm one.
MatrixXd terms_of_motion(const VibrationRecord& r, const PassBand& band, int stiffness_order) {
  MatrixXd A(r.n(), 2 + stiffness_order);
  A.col(0) = integrated(r.relative, r.rate, 0, band);
  A.col(1) = integrated(r.relative, r.rate, 1, band);
  const VectorXd z = integrated(r.relative, r.rate, 2, band);
  VectorXd power = VectorXd::Ones(r.n());
  for (int i = 0; i < stiffness_order; ++i) {
    power.array() *= z.array();
    A.col(2 + i) = filtered(power, r.rate, band);
  }
  const VectorXd norms = A.colwise().norm().cwiseMax(1e-300);
  return A * norms.cwiseInverse().asDiagonal();
}

/// Products of the terms with the base later by `shift` samples, a column for each window.
MatrixXd products(const MatrixXd& A, const VectorXd& base, int shift) {
  const Eigen::Index length = A.rows() / n_stretches;
  MatrixXd result = MatrixXd::Zero(A.cols(), n_stretches);
  for (Eigen::Index w = 0; w < n_stretches; ++w) {
    const Eigen::Index begin = std::max<Eigen::Index>(w * length, -shift);
    const Eigen::Index end = std::min((w + 1) * length, base.size() - shift);
    if (end > begin)
      result.col(w) = A.middleRows(begin, end - begin).transpose() * base.segment(begin + shift, end - begin);
  }
  return result;
}

/// The longer part, its base shifted if it is the later one.
VibrationRecord part_of(const VibrationRecord& r, Eigen::Index from, int shift) {
  const Eigen::Index margin = r.n() / n_stretches, n = r.n();
  VibrationRecord part = r;
  if (2 * from > n) {
    const Eigen::Index length = from - margin;
    part.base = r.base.head(length);
    part.relative = r.relative.head(length);
    return part;
  }
  const Eigen::Index begin = std::max<Eigen::Index>(from + (from > 0 ? margin : 0), std::max(0, -shift));
  const Eigen::Index length = n - begin - std::max(0, shift);
  part.base = r.base.segment(begin + shift, length);
  part.relative = r.relative.segment(begin, length);
  return part;
}

}  // namespace

std::optional<LostSamples> lost_samples(const VibrationRecord& r, int stiffness_order) {
  if (r.n() < n_stretches * 4 * most_lost) return std::nullopt;
  // The upper half of the band: low frequencies of z'' that are integrated twice are mostly noise.
  const PassBand band{.low = std::sqrt(r.band_low * r.band_high), .high = std::min(1.2 * r.band_high, 0.38 * r.rate)};
  const VectorXd base = filtered(r.base, r.rate, band);
  const MatrixXd A = terms_of_motion(r, band, stiffness_order);
  MatrixXd normal = A.transpose() * A;
  normal.diagonal().array() += 1e-10;
  const double all = base.squaredNorm();
  const auto left = [&](const VectorXd& b) { return std::max(all - b.dot(solve_symmetric(normal, b)), 0.0); };
  const MatrixXd as_recorded = products(A, base, 0);
  const double before = left(as_recorded.rowwise().sum());
  double least = less * less * before;
  std::optional<LostSamples> found;
  for (int shift = -most_lost; shift <= most_lost; ++shift) {
    if (shift == 0) continue;
    const MatrixXd moved = products(A, base, shift);
    VectorXd b = moved.rowwise().sum();
    for (Eigen::Index w = 0; w < n_stretches; ++w) {
      if (const double there = left(b); there < least) {
        least = there;
        const Eigen::Index first_sample = w * (r.n() / n_stretches);
        found = LostSamples{.time = static_cast<double>(first_sample) / r.rate, .number = shift};
      }
      b += as_recorded.col(w) - moved.col(w);
    }
  }
  if (!found) return std::nullopt;
  // Windows in which hardly anything happens, as at the beginning of a sweep, do not tell when samples were lost.
  constexpr double as_little = 1.1;
  if (left(products(A, base, found->number).rowwise().sum()) < as_little * least) found->time = 0.0;
  found->unexplained = std::sqrt(least / before);
  found->longer = part_of(r, static_cast<Eigen::Index>(std::lround(found->time * r.rate)), found->number);
  return found;
}

}  // namespace pfdm
