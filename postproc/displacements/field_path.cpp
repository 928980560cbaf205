#include "postproc/displacements/field_path.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr double rounding = 1e-6;  // of a range: a run's last displacement is not exact

}  // namespace

FieldPath::FieldPath(const SampledCurve& followed, const SetUp& set_up, const std::vector<MeasuredEvent>& events,
                     std::size_t specimen) {
  double before = 0.0, force_before = 0.0;  // of the step before
  const auto add = [&](double x, double force, const Knot& knot) {
    curve_.x.push_back(x);
    curve_.y.push_back(force + set_up.force_offset);
    knots_.push_back(knot);
  };
  for (std::size_t i = 0; i < followed.x.size(); ++i) {
    const double force = followed.y[i], x = followed.x[i] + set_up.offset + set_up.compliance * force;
    if (curve_.x.empty() || x >= curve_.x.back()) {
      if (i > 0 && before < curve_.x.back()) {  // it comes back from a fall
        const double last = curve_.x.back(), share = (last - before) / (x - before);
        add(last, force_before + share * (force - force_before), {i - 1, i, share});
      }
      add(x, force, {i, i, 0.0});
    }
    before = x;
    force_before = force;
  }
  parts_ = parts_between_jumps(curve_, events, specimen);
}

void FieldPath::add_inside(const CurvePart& part, double x, double weight, StepWeights& to) const {
  const auto add = [&](std::size_t row, double share) {
    const Knot& knot = knots_[row];
    if (knot.share != 1.0) to.emplace_back(knot.before, weight * share * (1.0 - knot.share));
    if (knot.share != 0.0) to.emplace_back(knot.after, weight * share * knot.share);
  };
  const auto begin = curve_.x.begin() + part.first, end = curve_.x.begin() + part.end;
  const auto above = std::upper_bound(begin, end, x);
  if (above == end) return add(part.end - 1, 1.0);
  if (above == begin) return add(part.first, 1.0);
  const auto row = static_cast<std::size_t>(above - curve_.x.begin());
  const double share = (x - curve_.x[row - 1]) / (curve_.x[row] - curve_.x[row - 1]);
  add(row - 1, 1.0 - share);
  add(row, share);
}

std::optional<StepWeights> FieldPath::at(double recorded) const {
  const double length = curve_.x.back() - curve_.x.front();
  const CurvePart& part =
      *std::ranges::find_if(parts_, [&](const CurvePart& p) { return recorded < p.to || &p == &parts_.back(); });
  const double first = curve_.x[part.first], last = curve_.x[part.end - 1];
  const bool is_last = &part == &parts_.back();
  if (is_last && recorded > last + rounding * length) return std::nullopt;
  StepWeights weights;
  const double reach = share_of_slope * length;
  const auto go_on = [&](double end, double from, double to) {  // with the slope between two places
    add_inside(part, end, 1.0, weights);
    if (!(to > from)) return;
    add_inside(part, to, (recorded - end) / (to - from), weights);
    add_inside(part, from, -(recorded - end) / (to - from), weights);
  };
  if (recorded < first)
    go_on(first, first, std::min(first + reach, last));
  else if (recorded > last && !is_last)
    go_on(last, std::max(last - reach, first), last);
  else
    add_inside(part, recorded, 1.0, weights);
  return weights;
}

}  // namespace pfdm
