#include "postproc/curves/curve_jumps.h"

#include <algorithm>

namespace pfdm {

std::vector<std::size_t> rows_before_jumps(const SampledCurve& curve, double least_fall) {
  std::vector<std::size_t> rows;
  if (curve.y.empty()) return rows;
  const double largest = std::ranges::max(curve.y);
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i)
    if (curve.y[i] - curve.y[i + 1] > least_fall * largest) rows.push_back(i);
  return rows;
}

std::vector<double> jumps_of(const SampledCurve& curve, double least_fall) {
  std::vector<double> jumps;
  for (const std::size_t row : rows_before_jumps(curve, least_fall)) jumps.push_back(curve.x[row]);
  return jumps;
}

JumpAlignment::JumpAlignment(const SampledCurve& from, const SampledCurve& to, double least_fall) {
  std::vector<double> theirs = jumps_of(from, least_fall), due = jumps_of(to, least_fall);
  if (theirs.empty() || theirs.size() != due.size()) return;
  for (std::vector<double>* places : {&theirs, &due}) {
    places->insert(places->begin(), std::min(from.x.front(), to.x.front()));
    places->push_back(std::max(from.x.back(), to.x.back()));
    if (std::ranges::adjacent_find(*places, std::ranges::greater_equal{}) != places->end()) return;
  }
  from_ = std::move(theirs);
  to_ = std::move(due);
}

SampledCurve JumpAlignment::operator()(SampledCurve curve) const {
  if (from_.empty()) return curve;
  const auto move = [this](double& x) {
    if (x <= from_.front() || x >= from_.back()) return;
    const auto k = static_cast<std::size_t>(std::ranges::upper_bound(from_, x) - from_.begin());
    x = to_[k - 1] + (x - from_[k - 1]) * (to_[k] - to_[k - 1]) / (from_[k] - from_[k - 1]);
  };
  std::ranges::for_each(curve.x, move);
  return curve;
}

}  // namespace pfdm
