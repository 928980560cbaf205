#include "solver/fracture/equilibrium/relaxation.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double least_share = 1.0 / 16.0, recovery = 1.5;
constexpr double least_factor = 0.5;
// Net over summed change of a stretch below which the largest secant factor is reduced.
constexpr double least_progress = 0.5, tightening = 0.5, loosening = 1.5;
// Net over summed change of a stretch below which it counts as a limit cycle.
constexpr double progress_of_circles = 0.3;

}  // namespace

CellField<double> Relaxation::next(const CellField<double>& d, const CellField<double>& answer,
                                   const CellField<double>& lower) {
  CellField<double> result = mixing_                 ? mixing_->next(d, answer, lower)
                             : way_ == Way::momentum ? accelerated(d, answer, lower)
                                                     : over_relaxed(d, answer, lower);
  if (const auto progress = progress_.of_step(d, result)) circles_ = *progress < progress_of_circles ? circles_ + 1 : 0;
  if (circles_ < most_circles || mixing_) return result;
  circles_ = 0;
  mixing_.emplace();
  return progress_.mean();
}

// Renews the increments and the cells' own factors; returns the increments of the iteration before, zero at first.
CellField<double> Relaxation::renew_increment(const CellField<double>& d, const CellField<double>& answer) {
  const Index n = d.size();
  if (increment_.size() != n) increment_ = CellField<double>(n, 0.0), share_ = CellField<double>(n, 1.0);
  CellField<double> before = std::exchange(increment_, CellField<double>(n));
  parallel_for(n, [&](Index c) {
    increment_[c] = answer[c] - d[c];
    const bool turned = increment_[c] * before[c] < 0.0;
    share_[c] = turned ? std::max(0.5 * share_[c], least_share) : std::min(recovery * share_[c], 1.0);
  });
  return before;
}

CellField<double> Relaxation::accelerated(const CellField<double>& d, const CellField<double>& answer,
                                          const CellField<double>& lower) {
  const Index n = d.size();
  renew_increment(d, answer);
  CellField<double> relaxed(n);
  parallel_for(n, [&](Index c) { relaxed[c] = d[c] + share_[c] * increment_[c]; });
  CellField<double> result = relaxed;
  if (relaxed_.size() == n) {
    const double factor = momentum(relaxed);
    parallel_for(n, [&](Index c) {
      const double step = relaxed[c] - relaxed_[c];
      if (share_[c] == 1.0 && increment_[c] * step > 0.0)
        result[c] = std::clamp(relaxed[c] + factor * step, lower[c], 1.0);
    });
  }
  relaxed_ = std::move(relaxed);
  return result;
}

// Momentum along the step from the relaxed damage before to this.
double Relaxation::momentum(const CellField<double>& relaxed) {
  const double along =
      parallel_sum(relaxed.size(), [&](Index c) { return increment_[c] * (relaxed[c] - relaxed_[c]); });
  if (along < 0.0) inertia_ = 1.0;
  const double before = inertia_;
  inertia_ = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * before * before));
  return (before - 1.0) / inertia_;
}

CellField<double> Relaxation::over_relaxed(const CellField<double>& d, const CellField<double>& answer,
                                           const CellField<double>& lower) {
  const Index n = d.size();
  const bool first = increment_.size() != n;
  const CellField<double> before = renew_increment(d, answer);
  if (!first) {
    const auto fall = [&](Index c) { return share_[c] * (before[c] - increment_[c]); };
    const double along = parallel_sum(n, [&](Index c) { return share_[c] * before[c] * fall(c); });
    const double square = parallel_sum(n, [&](Index c) { return fall(c) * fall(c); });
    // An increment that does not decrease gets the largest factor.
    factor_ = along > 0.0 ? std::clamp(factor_ * along / square, least_factor, largest_factor_) : largest_factor_;
  }
  CellField<double> result(n);
  parallel_for(n, [&](Index c) {
    const double step = increment_[c] * before[c] < 0.0 ? share_[c] : factor_ * share_[c];
    result[c] = std::clamp(d[c] + step * increment_[c], lower[c], 1.0);
  });
  if (const auto progress = short_progress_.of_step(d, result))
    largest_factor_ = *progress < least_progress ? std::max(tightening * largest_factor_, 1.0)
                                                 : std::min(loosening * largest_factor_, most_factor);
  return result;
}

std::optional<double> Progress::of_step(const CellField<double>& from, const CellField<double>& to) {
  const Index n = from.size();
  if (steps_ == 0) begin_ = from, way_ = 0.0, sum_ = CellField<double>(n, 0.0);
  parallel_for(n, [&](Index c) { sum_[c] += to[c]; });
  way_ += parallel_sum(n, [&](Index c) { return std::abs(to[c] - from[c]); });
  if (++steps_ < stretch_) return std::nullopt;
  steps_ = 0;
  const double come = parallel_sum(n, [&](Index c) { return std::abs(to[c] - begin_[c]); });
  return way_ > 0.0 ? come / way_ : 1.0;
}

CellField<double> Progress::mean() const {
  CellField<double> result(sum_.size());
  for (Index c = 0; c < sum_.size(); ++c) result[c] = sum_[c] / stretch_;
  return result;
}

}  // namespace pfdm
