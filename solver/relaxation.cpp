#include "solver/relaxation.h"

#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr double least_factor = 0.5, most_factor = 5.0;

}  // namespace

CellField<double> Relaxation::next(const CellField<double>& d, const CellField<double>& answer,
                                   const CellField<double>& lower) {
  const Index n = d.size();
  CellField<double> increment(as_size(n)), result(as_size(n));
  parallel_for(n, [&](Index c) { increment[c] = answer[c] - d[c]; });
  const bool first = increment_.size() != n;
  if (!first) {
    const double along = parallel_sum(n, [&](Index c) { return increment_[c] * (increment_[c] - increment[c]); });
    const double square = parallel_sum(n, [&](Index c) {
      const double fall = increment_[c] - increment[c];
      return fall * fall;
    });
    // An increment that does not fall asks for the longest step.
    factor_ = along > 0.0 ? std::clamp(factor_ * along / square, least_factor, most_factor) : most_factor;
  }
  parallel_for(n, [&](Index c) {
    const bool turned = !first && increment[c] * increment_[c] < 0.0;
    result[c] = std::clamp(d[c] + (turned ? least_factor : factor_) * increment[c], lower[c], 1.0);
  });
  increment_ = std::move(increment);
  return result;
}

}  // namespace pfdm
