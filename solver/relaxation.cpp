#include "solver/relaxation.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr double least_factor = 0.5, most_factor = 5.0;
constexpr double least_share = 1.0 / 16.0, recovery = 1.5;

}  // namespace

CellField<double> Relaxation::next(const CellField<double>& d, const CellField<double>& answer,
                                   const CellField<double>& lower) {
  const Index n = d.size();
  const bool first = increment_.size() != n;
  if (first) increment_ = CellField<double>(as_size(n), 0.0), share_ = CellField<double>(as_size(n), 1.0);
  CellField<double> increment(as_size(n)), result(as_size(n));
  const auto turned = [&](Index c) { return increment[c] * increment_[c] < 0.0; };
  parallel_for(n, [&](Index c) {
    increment[c] = answer[c] - d[c];
    share_[c] = turned(c) ? std::max(0.5 * share_[c], least_share) : std::min(recovery * share_[c], 1.0);
  });
  if (!first) {
    const auto fall = [&](Index c) { return share_[c] * (increment_[c] - increment[c]); };
    const double along = parallel_sum(n, [&](Index c) { return share_[c] * increment_[c] * fall(c); });
    const double square = parallel_sum(n, [&](Index c) { return fall(c) * fall(c); });
    // An increment that does not fall asks for the longest step.
    factor_ = along > 0.0 ? std::clamp(factor_ * along / square, least_factor, most_factor) : most_factor;
  }
  parallel_for(n, [&](Index c) {
    const double step = turned(c) ? share_[c] : factor_ * share_[c];
    result[c] = std::clamp(d[c] + step * increment[c], lower[c], 1.0);
  });
  increment_ = std::move(increment);
  return result;
}

}  // namespace pfdm
