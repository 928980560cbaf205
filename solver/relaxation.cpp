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
  factor_ = 1.0;
  if (increment_.size() == n) {
    const double product = parallel_sum(n, [&](Index c) { return increment[c] * increment_[c]; });
    const double square = parallel_sum(n, [&](Index c) { return increment_[c] * increment_[c]; });
    const double contraction = square > 0.0 ? product / square : 0.0;
    factor_ = contraction < 1.0 ? std::clamp(1.0 / (1.0 - contraction), least_factor, most_factor) : most_factor;
  }
  parallel_for(n, [&](Index c) {
    const bool turned = increment_.size() == n && increment[c] * increment_[c] < 0.0;
    result[c] = std::clamp(d[c] + (turned ? 0.5 : factor_) * increment[c], lower[c], 1.0);
  });
  increment_ = std::move(increment);
  return result;
}

}  // namespace pfdm
