#include "cases/program/studies/sensitivity/curve_peak.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr std::size_t rows_of_smooth = 5, rows_of_side = 3;
constexpr double least_likeness = 0.5;  // of second differences of a smooth peak
constexpr double most_beside = 0.1;     // distance of the row from the sides of a corner, of the fall to the next rows
constexpr int n_parts = 80;

}  // namespace

CurvePeak::CurvePeak(const SampledCurve& curve, const CurveBranches& branches, std::size_t row)
    : curve_(curve), row_(row) {
  places_.fill({curve.x[row], curve.y[row]});
  const std::size_t branch = branches.branch_of(row);
  std::size_t first = row, end = row + 1;
  while (first > 0 && branches.branch_of(first - 1) == branch) --first;
  while (end < curve.x.size() && branches.branch_of(end) == branch) ++end;
  if (first == row || row + 1 == end || end - first < rows_of_smooth) return;
  const std::size_t from = std::clamp(row < first + 2 ? first : row - 2, first, end - rows_of_smooth);
  const Rows all{from, from + rows_of_smooth - 1};
  if (is_smooth(all)) {
    shape_ = Shape::smooth;
    const bool drops_first = row - all.first > all.last - row;
    left_ = {all, drops_first ? Rows{all.first + 1, all.last} : Rows{all.first, all.last - 1}};
    for (std::size_t k = 0; k < 2; ++k) {
      const double x = top(left_[k]);
      places_[k] = {x, polynomial(left_[k], curve_.y, x)[0]};
    }
  } else if (find_corner(first, end)) {
    shape_ = Shape::corner;
  } else {
    places_.fill({curve.x[row], curve.y[row]});
  }
}

std::array<double, 3> CurvePeak::polynomial(const Rows& rows, std::span<const double> of, double at) const {
  const std::size_t n = rows.last - rows.first + 1;
  const auto x = std::span(curve_.x).subspan(rows.first, n), values = of.subspan(rows.first, n);
  std::vector<double> y(values.begin(), values.end());
  for (std::size_t k = 1; k < n; ++k)  // divided differences
    for (std::size_t i = n - 1; i >= k; --i) y[i] = (y[i] - y[i - 1]) / (x[i] - x[i - k]);
  std::array<double, 3> sums{};
  for (std::size_t i = n; i-- > 0;) {
    const double apart = at - x[i];
    sums[2] = sums[2] * apart + 2.0 * sums[1];
    sums[1] = sums[1] * apart + sums[0];
    sums[0] = sums[0] * apart + y[i];
  }
  return sums;
}

bool CurvePeak::is_smooth(const Rows& rows) const {
  double least = 0.0, most = 0.0;
  for (std::size_t i = rows.first; i + 2 <= rows.last; ++i) {
    const double downward = -polynomial({i, i + 2}, curve_.y, curve_.x[i])[2];
    least = i == rows.first ? downward : std::min(least, downward);
    most = i == rows.first ? downward : std::max(most, downward);
  }
  return most > 0.0 && least >= least_likeness * most;
}

double CurvePeak::top(const Rows& rows) const {
  double from = curve_.x[row_ - 1], to = curve_.x[row_ + 1];
  for (int i = 0; i < n_parts; ++i) {
    const double middle = 0.5 * (from + to);
    (polynomial(rows, curve_.y, middle)[1] > 0.0 ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

bool CurvePeak::meet(const Rows& left, const Rows& right, double& at) const {
  const auto apart = [&](double x) { return polynomial(left, curve_.y, x)[0] - polynomial(right, curve_.y, x)[0]; };
  double from = curve_.x[row_ - 1], to = curve_.x[row_ + 1];
  if (!(apart(from) < 0.0) || !(apart(to) > 0.0)) return false;
  for (int i = 0; i < n_parts; ++i) {
    const double middle = 0.5 * (from + to);
    (apart(middle) < 0.0 ? from : to) = middle;
  }
  at = 0.5 * (from + to);
  return true;
}

bool CurvePeak::find_corner(std::size_t first, std::size_t end) {
  if (row_ - first < rows_of_side || end - row_ <= rows_of_side) return false;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t n = rows_of_side - k;
    left_[k] = {row_ - n, row_ - 1};
    right_[k] = {row_ + 1, row_ + n};
    Place& place = places_[k];
    if (!meet(left_[k], right_[k], place.x)) return false;
    place.y = polynomial(left_[k], curve_.y, place.x)[0];
  }
  return lies_on_a_side();
}

bool CurvePeak::lies_on_a_side() const {
  const double x = curve_.x[row_], y = curve_.y[row_];
  const double fall = y - std::min(curve_.y[row_ - 1], curve_.y[row_ + 1]);
  const double beside =
      std::min(std::abs(polynomial(left_[0], curve_.y, x)[0] - y), std::abs(polynomial(right_[0], curve_.y, x)[0] - y));
  return beside <= most_beside * fall;
}

std::array<CurvePeak::Place, 2> CurvePeak::moved_by(std::span<const double> change) const {
  std::array<Place, 2> moved{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double x = places_[k].x;
    const auto curve = polynomial(left_[k], curve_.y, x), by = polynomial(left_[k], change, x);
    if (shape_ == Shape::smooth) {
      moved[k] = {-by[1] / curve[2], by[0]};
      continue;
    }
    const auto behind = polynomial(right_[k], curve_.y, x), by_behind = polynomial(right_[k], change, x);
    moved[k].x = (by_behind[0] - by[0]) / (curve[1] - behind[1]);
    moved[k].y = by[0] + curve[1] * moved[k].x;
  }
  return moved;
}

}  // namespace pfdm
