#include "cases/program/studies/sensitivity/curve_branches.h"

#include "postproc/curves/curve_jumps.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

CurveBranches::CurveBranches(const SampledCurve& curve) : curve_(curve), first_{0} {
  const std::vector<std::size_t> before = rows_before_jumps(curve, fall_of_jump);
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i)
    if (!(curve.x[i + 1] > curve.x[i]) || std::ranges::count(before, i) > 0) first_.push_back(i + 1);
  first_.push_back(curve.x.size());
}

std::size_t CurveBranches::branch_of(std::size_t row) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(first_, row) - first_.begin()) - 1;
}

std::optional<CurveBranches::Place> CurveBranches::at(double x) const {
  for (std::size_t b = 0; b < n(); ++b)
    if (curve_.x[first_[b]] <= x && x <= curve_.x[first_[b + 1] - 1]) return Place{b, interpolated(b, x)};
  return std::nullopt;
}

double CurveBranches::interpolated(std::size_t branch, double x) const {
  const std::size_t from = first_[branch], to = first_[branch + 1];
  const auto begin = curve_.x.begin();
  const auto above = std::upper_bound(begin + from, begin + to, x);
  const std::size_t next = static_cast<std::size_t>(above - begin), n_points = std::min<std::size_t>(4, to - from);
  const std::size_t least = std::min(next >= from + 2 ? next - 2 : from, to - n_points);
  double sum = 0.0;
  for (std::size_t i = least; i < least + n_points; ++i) {
    double weight = 1.0;
    for (std::size_t j = least; j < least + n_points; ++j)
      if (j != i) weight *= (x - curve_.x[j]) / (curve_.x[i] - curve_.x[j]);
    sum += weight * curve_.y[i];
  }
  return sum;
}

double CurveBranches::slope(std::size_t row) const {
  const std::size_t b = branch_of(row), lower = row > first_[b] ? row - 1 : row,
                    upper = row + 1 < first_[b + 1] ? row + 1 : row;
  return upper > lower ? std::abs((curve_.y[upper] - curve_.y[lower]) / (curve_.x[upper] - curve_.x[lower])) : 0.0;
}

}  // namespace pfdm
