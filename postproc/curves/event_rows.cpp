#include "postproc/curves/event_rows.h"

#include "physics/error.h"
#include "postproc/curves/recorded_jumps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pfdm {
namespace {

constexpr double surely_on_its_side = 3.0;  // standard deviations of a jump's displacement

bool is_on_wrong_side(const MeasuredPoints::Point& point, const MeasuredEvent& event) {
  return event.kind == EventKind::jump && event.specimen == point.specimen &&
         std::abs(point.x - event.place) <= surely_on_its_side * event.deviation_of_place();
}

bool is_on_side_of(EventFigure figure, const MeasuredPoints::Point& point, double place) {
  if (figure == EventFigure::force_before) return point.x <= place;
  return figure == EventFigure::force || point.x > place;
}

/// Marks the nearest points that together know the force as well as it was measured.
void mark_points_of(const MeasuredFigure& force, const MeasuredEvent& event,
                    const std::vector<MeasuredPoints::Point>& points, std::vector<bool>& is_left_out) {
  constexpr double as_well = 1.0 - 1e-6;
  std::vector<std::size_t> nearest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].specimen == event.specimen && is_on_side_of(force.figure, points[i], event.place))
      nearest.push_back(i);
  std::ranges::stable_sort(nearest, {}, [&](std::size_t i) { return std::abs(points[i].x - event.place); });
  nearest.resize(std::min(nearest.size(), rows_of_force));
  double known = 0.0;  // of the force, over what its standard deviation says
  for (const std::size_t i : nearest) {
    if (known > as_well) return;
    is_left_out[i] = true;
    known += std::pow(force.deviation / points[i].deviation, 2);
  }
}

}  // namespace

double displacement_of_specimen(const MeasuredCurve& measured, double recorded) {
  return SampledCurve{.name = "", .x = measured.curve.x, .y = measured.of_specimen().x}.at(recorded);
}

void leave_out_rows_of_events(MeasuredPoints& measured) {
  const std::size_t n = measured.points.size();
  std::vector<bool> is_left_out(n);
  for (std::size_t i = 0; i < n; ++i)
    is_left_out[i] = std::ranges::any_of(
        measured.events, [&](const MeasuredEvent& event) { return is_on_wrong_side(measured.points[i], event); });
  for_each_datum(measured.events, [&](const MeasuredEvent& event, const MeasuredFigure& figure) {
    if (figure.figure != EventFigure::displacement) mark_points_of(figure, event, measured.points, is_left_out);
  });
  std::vector<MeasuredPoints::Point> left;
  for (std::size_t i = 0; i < n; ++i)
    if (!is_left_out[i]) left.push_back(measured.points[i]);
  if (left.empty()) throw InputError("the events take the place of all measured points: none is left");
  measured.left_out = n - left.size();
  measured.points = std::move(left);
}

}  // namespace pfdm
