#include "postproc/curves/curve_events.h"

#include "physics/quantity_text.h"
#include "postproc/curves/curve_jumps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace pfdm {
namespace {

/// What stands for an event that is nowhere.
ComputedEvent end_of(const SampledCurve& curve) {
  const std::size_t last = curve.x.size() - 1;
  return {.before = last,
          .after = last,
          .displacement = curve.x.back(),
          .force_before = curve.y.back(),
          .force_after = curve.y.back()};
}

/// Steps one after the other, in each of which the force falls: rows [before, after].
struct Fall {
  std::size_t before = 0, after = 0, steepest = 0;  ///< `steepest`: row before the step that falls most
};

double fall_behind(const SampledCurve& curve, std::size_t row) { return curve.y[row] - curve.y[row + 1]; }

std::vector<Fall> jumps_in(const SampledCurve& curve, double least_fall) {
  std::vector<Fall> falls;
  for (const std::size_t row : rows_before_jumps(curve, least_fall)) {
    if (falls.empty() || falls.back().after != row) falls.push_back({row, row + 1, row});
    Fall& fall = falls.back();
    fall.after = row + 1;
    if (fall_behind(curve, row) > fall_behind(curve, fall.steepest)) fall.steepest = row;
  }
  return falls;
}

double place_of(const SampledCurve& curve, const Fall& fall) {
  return 0.5 * (curve.x[fall.steepest] + curve.x[fall.steepest + 1]);
}

/// A step that a compliance of the set-up has taken back is as long as the one before.
double step_behind(const SampledCurve& curve, std::size_t row) {
  const double step = curve.x[row + 1] - curve.x[row];
  return step > 0.0 || row == 0 ? step : curve.x[row] - curve.x[row - 1];
}

ComputedEvent jump_by(const SampledCurve& curve, const Fall& fall, bool is_there) {
  return {.is_there = is_there,
          .before = fall.before,
          .after = fall.after,
          .displacement = place_of(curve, fall),
          .step = is_there ? step_behind(curve, fall.steepest) : 0.0,
          .force_before = curve.y[fall.before],
          .force_after = curve.y[fall.after]};
}

/// Where there is no jump: the largest fall in one step behind the other jumps, or else the end.
ComputedEvent instead_of_jump(const SampledCurve& curve, const std::vector<Fall>& jumps) {
  std::optional<std::size_t> most;
  for (std::size_t i = jumps.empty() ? 0 : jumps.back().after; i + 1 < curve.x.size(); ++i)
    if (fall_behind(curve, i) > (most ? fall_behind(curve, *most) : 0.0)) most = i;
  if (most) return jump_by(curve, {*most, *most + 1, *most}, false);
  return end_of(curve);
}

ComputedEvent computed_jump(const MeasuredEvent& event, const SampledCurve& curve) {
  const std::vector<Fall> jumps = jumps_in(curve, event.least_fall);
  const auto number = static_cast<std::size_t>(event.number.value_or(1));
  if (number > jumps.size()) return instead_of_jump(curve, jumps);
  if (event.number) return jump_by(curve, jumps[number - 1], true);
  const auto distance = [&](const Fall& fall) { return std::abs(place_of(curve, fall) - event.place); };
  return jump_by(curve, *std::ranges::min_element(jumps, {}, distance), true);
}

ComputedEvent computed_greatest(const SampledCurve& curve) {
  const auto row = static_cast<std::size_t>(std::ranges::max_element(curve.y) - curve.y.begin());
  if (row + 1 == curve.x.size()) return end_of(curve);
  const std::size_t before = row > 0 ? row - 1 : 0;
  return {.is_there = true,
          .before = row,
          .after = row,
          .displacement = curve.x[row],
          .step = (curve.x[row + 1] - curve.x[before]) / static_cast<double>(row + 1 - before),
          .force_before = curve.y[row],
          .force_after = curve.y[row]};
}

ComputedEvent computed_debonding(const SampledCurve& curve) {
  if (!curve.first_debonding || *curve.first_debonding + 1 >= curve.x.size()) return end_of(curve);
  const std::size_t row = *curve.first_debonding;
  return jump_by(curve, {row, row + 1, row}, true);
}

/// A part of a curve without jumps.
struct Branch {
  std::span<const double> x, y;

  /// Beyond its ends it goes on with its mean slope over `reach`.
  double at(double place, double reach) const {
    if (place < x.front())
      return y.front() + slope(x.front(), std::min(x.front() + reach, x.back())) * (place - x.front());
    if (place > x.back()) return y.back() + slope(std::max(x.back() - reach, x.front()), x.back()) * (place - x.back());
    return inside(place);
  }

 private:
  double inside(double place) const {
    const auto above = std::ranges::upper_bound(x, place);
    if (above == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(above - x.begin());
    return y[i - 1] + (place - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  }
  double slope(double from, double to) const { return to > from ? (inside(to) - inside(from)) / (to - from) : 0.0; }
};

/// A jump of the model, rows before and after, and where it was measured.
struct Pair {
  std::size_t before = 0, after = 0;
  double place = 0.0;
  double apart = 0.0;  ///< from there

  bool is_in_order_with(const Pair& other) const {
    return place < other.place ? after <= other.before : other.place < place && other.after <= before;
  }
};

/// The measured jumps of a specimen that the model has.
std::vector<Pair> jumps_of_model(const SampledCurve& model, const std::vector<MeasuredEvent>& events,
                                 std::size_t specimen) {
  std::vector<Pair> pairs;
  for (const MeasuredEvent& event : events) {
    if (event.kind != EventKind::jump || event.specimen != specimen) continue;
    const ComputedEvent computed = computed_event(event, model);
    if (computed.is_there)
      pairs.push_back({computed.before, computed.after, event.place, std::abs(computed.displacement - event.place)});
  }
  return pairs;
}

/// Rising in both: of those that are the same jump, or in another order, the nearest.
std::vector<Pair> in_order(std::vector<Pair> pairs) {
  std::ranges::stable_sort(pairs, {}, &Pair::apart);
  std::vector<Pair> kept;
  for (const Pair& pair : pairs)
    if (std::ranges::all_of(kept, [&](const Pair& other) { return pair.is_in_order_with(other); }))
      kept.push_back(pair);
  std::ranges::sort(kept, {}, &Pair::place);
  return kept;
}

}  // namespace

std::string_view name_of(EventKind kind) {
  switch (kind) {
    case EventKind::greatest_force: return "greatest force";
    case EventKind::first_debonding: return "first debonding";
    case EventKind::jump: break;
  }
  return "jump";
}

std::string_view name_of(EventFigure figure) {
  switch (figure) {
    case EventFigure::displacement: return "displacement";
    case EventFigure::force_before: return "force_before";
    case EventFigure::force_after: return "force_after";
    case EventFigure::force: break;
  }
  return "force";
}

std::string_view unit_of(EventFigure figure) { return figure == EventFigure::displacement ? "m" : "N"; }

std::string in_words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string event_words(const MeasuredEvent& event, std::string_view specimen) {
  std::vector<std::string> data;
  for (const MeasuredFigure& f : event.figures)
    if (f.counts)
      data.push_back(fmt::format("{} {}, standard deviation {}", in_words(f.figure),
                                 quantity_text(f.value, unit_of(f.figure)),
                                 quantity_text(f.deviation, unit_of(f.figure), 2)));
  return fmt::format("{} of {}{}: {}", event.name(), specimen, event.is_found ? ", found in the record" : "",
                     fmt::join(data, "; "));
}

std::string MeasuredEvent::name() const {
  if (kind != EventKind::jump) return std::string(name_of(kind));
  return number ? fmt::format("jump {}", *number) : fmt::format("jump at {}", quantity_text(place, "m"));
}

double MeasuredEvent::deviation_of_place() const {
  const auto figure = std::ranges::find(figures, EventFigure::displacement, &MeasuredFigure::figure);
  return figure != figures.end() && figure->counts ? figure->deviation : 0.0;
}

double ComputedEvent::of(EventFigure figure) const {
  if (figure == EventFigure::displacement) return displacement;
  return figure == EventFigure::force_after ? force_after : force_before;
}

double residual_of(const ComputedEvent& computed, const MeasuredFigure& measured) {
  return (computed.of(measured.figure) - measured.value) / measured.deviation;
}

double step_at(const SampledCurve& curve, double displacement) {
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(curve.x, displacement) - curve.x.begin());
  return step_behind(curve, std::clamp<std::size_t>(above, 1, curve.x.size() - 1) - 1);
}

ComputedEvent computed_event(const MeasuredEvent& event, const SampledCurve& model) {
  switch (event.kind) {
    case EventKind::jump: return computed_jump(event, model);
    case EventKind::first_debonding: return computed_debonding(model);
    case EventKind::greatest_force: break;
  }
  return computed_greatest(model);
}

std::vector<CurvePart> parts_between_jumps(const SampledCurve& model, const std::vector<MeasuredEvent>& events,
                                           std::size_t specimen) {
  std::vector<CurvePart> parts(1);
  for (const Pair& jump : in_order(jumps_of_model(model, events, specimen))) {
    parts.back().end = jump.before + 1;
    parts.back().to = jump.place;
    parts.push_back({.first = jump.after, .from = jump.place});
  }
  parts.back().end = model.x.size();
  return parts;
}

SampledCurve with_jumps_as_measured(const SampledCurve& model, const std::vector<MeasuredEvent>& events,
                                    std::size_t specimen) {
  const std::vector<CurvePart> parts = parts_between_jumps(model, events, specimen);
  if (parts.size() == 1) return model;
  const double reach = share_of_slope * (model.x.back() - model.x.front());
  SampledCurve moved{.name = model.name, .x = {}, .y = {}};
  const auto add = [&](double x, double y) {
    moved.x.push_back(x);
    moved.y.push_back(y);
  };
  for (const CurvePart& part : parts) {
    const Branch branch{.x = std::span(model.x).subspan(part.first, part.end - part.first),
                        .y = std::span(model.y).subspan(part.first, part.end - part.first)};
    if (std::isfinite(part.from)) add(part.from, branch.at(part.from, reach));
    for (std::size_t i = 0; i < branch.x.size(); ++i)
      if (branch.x[i] > part.from && branch.x[i] < part.to) add(branch.x[i], branch.y[i]);
    if (std::isfinite(part.to)) add(part.to, branch.at(part.to, reach));
  }
  return moved;
}

bool has_jumps_in_order(const SampledCurve& model, const std::vector<MeasuredEvent>& events, std::size_t specimen) {
  const std::vector<Pair> jumps = jumps_of_model(model, events, specimen);
  return in_order(jumps).size() == jumps.size();
}

SampledCurve up_to(const SampledCurve& curve, double displacement) {
  if (!(curve.x.back() > displacement) || !(curve.x.front() < displacement)) return curve;
  SampledCurve part{.name = curve.name, .x = {}, .y = {}};
  for (std::size_t i = 0; i < curve.x.size() && curve.x[i] < displacement; ++i) {
    part.x.push_back(curve.x[i]);
    part.y.push_back(curve.y[i]);
  }
  part.x.push_back(displacement);
  part.y.push_back(curve.at(displacement));
  if (curve.first_debonding && *curve.first_debonding + 1 < part.x.size() &&
      curve.x[*curve.first_debonding + 1] <= displacement)
    part.first_debonding = curve.first_debonding;
  return part;
}

}  // namespace pfdm
