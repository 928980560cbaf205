#include "postproc/curves/recorded_jumps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pfdm {
namespace {

constexpr std::size_t least_rows = 4;  // of a line
constexpr double significant = 4.0;    // standard errors of a fall
constexpr std::size_t nearby = 3;      // gaps in which the jump may be as well

/// Least squares through rows [first, end), each with the weight of its standard deviation.
struct Line {
  double x = 0.0, y = 0.0, slope = 0.0;              ///< through the centre of the rows
  double weight = 0.0, moment = 0.0, squares = 0.0;  ///< sums: of weights, of w (x - centre)^2, of w residual^2

  double at(double place) const { return y + slope * (place - x); }
  double variance(double place) const {
    return 1.0 / weight + (moment > 0.0 ? (place - x) * (place - x) / moment : 0.0);
  }
};

Line line_through(const SampledCurve& rows, std::size_t first, std::size_t end) {
  Line line;
  const auto weight = [&](std::size_t i) { return 1.0 / (rows.deviation[i] * rows.deviation[i]); };
  for (std::size_t i = first; i < end; ++i) {
    line.weight += weight(i);
    line.x += weight(i) * rows.x[i];
    line.y += weight(i) * rows.y[i];
  }
  line.x /= line.weight;
  line.y /= line.weight;
  double product = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    line.moment += weight(i) * (rows.x[i] - line.x) * (rows.x[i] - line.x);
    product += weight(i) * (rows.x[i] - line.x) * (rows.y[i] - line.y);
  }
  if (line.moment > 0.0) line.slope = product / line.moment;
  for (std::size_t i = first; i < end; ++i) line.squares += weight(i) * std::pow(rows.y[i] - line.at(rows.x[i]), 2);
  return line;
}

/// Lines on both sides of the gap behind a row.
struct Gap {
  std::size_t row = 0;
  double middle = 0.0, width = 0.0;
  Line before, after;

  double fall() const { return before.at(middle) - after.at(middle); }
  double error() const { return std::sqrt(before.variance(middle) + after.variance(middle)); }
};

double mean_spacing(const SampledCurve& rows, std::size_t first, std::size_t end) {
  return (rows.x[end - 1] - rows.x[first]) / static_cast<double>(end - 1 - first);
}

/// Through rows [first, end). A gap of no width is as wide as rows lie apart, about it or in the whole record: there
/// the machine has waited.
Gap gap_behind(const SampledCurve& rows, std::size_t row, std::size_t first, std::size_t end) {
  double width = rows.x[row + 1] - rows.x[row];
  if (!(width > 0.0)) width = mean_spacing(rows, first, end);
  if (!(width > 0.0)) width = mean_spacing(rows, 0, rows.x.size());
  return {.row = row,
          .middle = 0.5 * (rows.x[row] + rows.x[row + 1]),
          .width = width,
          .before = line_through(rows, first, row + 1),
          .after = line_through(rows, row + 1, end)};
}

std::size_t first_row(std::size_t row) { return row + 1 >= rows_of_force ? row + 1 - rows_of_force : 0; }
std::size_t end_row(const SampledCurve& rows, std::size_t row) {
  return std::min(row + 1 + rows_of_force, rows.x.size());
}

/// Of gaps close to each other the one with the largest fall.
std::vector<std::size_t> rows_before_falls(const SampledCurve& rows, double least) {
  std::vector<Gap> gaps;
  for (std::size_t i = least_rows - 1; i + least_rows < rows.x.size(); ++i) {
    Gap gap = gap_behind(rows, i, first_row(i), end_row(rows, i));
    if (gap.fall() > std::max(least, significant * gap.error())) gaps.push_back(gap);
  }
  std::ranges::stable_sort(gaps, std::ranges::greater{}, &Gap::fall);
  std::vector<std::size_t> found;
  for (const Gap& gap : gaps) {
    const auto is_near = [&](std::size_t other) {
      return std::max(other, gap.row) - std::min(other, gap.row) < rows_of_force;
    };
    if (std::ranges::none_of(found, is_near)) found.push_back(gap.row);
  }
  std::ranges::sort(found);
  return found;
}

RecordedJump jump_near(const SampledCurve& rows, std::size_t row) {
  const std::size_t first = first_row(row), end = end_row(rows, row);
  std::vector<Gap> gaps;
  for (std::size_t i = std::max(row, nearby) - nearby; i <= row + nearby; ++i)
    if (i + 1 >= first + least_rows && i + 1 + least_rows <= end) gaps.push_back(gap_behind(rows, i, first, end));
  const auto squares = [](const Gap& gap) { return gap.before.squares + gap.after.squares; };
  const Gap best = *std::ranges::min_element(gaps, {}, squares);
  double sum = 0.0, mean = 0.0, mean_square = 0.0;
  for (const Gap& gap : gaps) {
    const double weight = gap.width * std::exp(-0.5 * (squares(gap) - squares(best)));
    sum += weight;
    mean += weight * gap.middle;
    mean_square += weight * (std::pow(gap.middle - best.middle, 2) + gap.width * gap.width / 12.0);
  }
  mean /= sum;
  const double variance = mean_square / sum - std::pow(mean - best.middle, 2);
  return {.displacement = mean,
          .deviation = std::sqrt(variance),
          .force_before = best.before.at(mean),
          .force_after = best.after.at(mean),
          .deviation_before = std::sqrt(best.before.variance(mean)),
          .deviation_after = std::sqrt(best.after.variance(mean))};
}

}  // namespace

std::vector<RecordedJump> recorded_jumps(const SampledCurve& record, double least_fall) {
  std::vector<RecordedJump> jumps;
  if (record.y.empty()) return jumps;
  const double least = least_fall * std::ranges::max(record.y);
  for (const std::size_t row : rows_before_falls(record, least)) jumps.push_back(jump_near(record, row));
  return jumps;
}

}  // namespace pfdm
