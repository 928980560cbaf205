#include "postproc/curves/curve_events.h"
#include "postproc/curves/event_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double step = 0.1, fall = 3.0;

/// Rises with slope 1 up to `jump` (in steps from zero), falls by 3 within the step behind it, and rises with slope 0.5
/// up to 10 and a little beyond.
SampledCurve curve_with(double jump) {
  SampledCurve curve{.name = "computed", .x = {}, .y = {}};
  const auto force = [&](double x) { return x <= jump ? x : jump - fall + 0.5 * (x - jump); };
  for (double x = std::fmod(jump, step) - step; x < 10.0 + 2.0 * step; x += step) {
    curve.x.push_back(x);
    curve.y.push_back(force(x - 1e-12));
  }
  return curve;
}

MeasuredEvent jump_measured_at(double place, double deviation) {
  return {.kind = EventKind::jump, .place = place, .figures = {{EventFigure::displacement, place, deviation}}};
}

TEST(CurveEvents, AreFiguresOfTheComputedCurve) {
  const SampledCurve curve = curve_with(6.0);
  const ComputedEvent jump = computed_event(jump_measured_at(5.0, 0.1), curve);
  EXPECT_TRUE(jump.is_there);
  EXPECT_NEAR(jump.displacement, 6.0 + step / 2, 1e-9);
  EXPECT_NEAR(jump.step, step, 1e-9);
  EXPECT_NEAR(jump.of(EventFigure::force_before), 6.0, 1e-9);
  EXPECT_NEAR(jump.of(EventFigure::force_after), 3.0 + 0.5 * step, 1e-9);
  const ComputedEvent greatest = computed_event({.kind = EventKind::greatest_force}, curve);
  EXPECT_NEAR(greatest.of(EventFigure::force), 6.0, 1e-9);
  EXPECT_NEAR(greatest.of(EventFigure::displacement), 6.0, 1e-9);
}

TEST(CurveEvents, HaveTheirNumberOrAreTheNearest) {
  const SampledCurve curve{.name = "", .x = {0, 1, 2, 3, 4, 5, 6, 7}, .y = {0, 10, 8, 5, 6, 7, 3, 4}};
  MeasuredEvent event = jump_measured_at(2.6, 0.1);
  // Falls of 2 and 3 one after the other are one jump, in the middle of the larger.
  EXPECT_DOUBLE_EQ(computed_event(event, curve).displacement, 2.5);
  EXPECT_DOUBLE_EQ(computed_event(event, curve).force_before, 10.0);
  EXPECT_DOUBLE_EQ(computed_event(event, curve).force_after, 5.0);
  event.place = 4.9;
  EXPECT_DOUBLE_EQ(computed_event(event, curve).displacement, 5.5);
  event.number = 1;
  EXPECT_DOUBLE_EQ(computed_event(event, curve).displacement, 2.5);
  event.number = 2;
  EXPECT_DOUBLE_EQ(computed_event(event, curve).displacement, 5.5);
  event.number = 3;
  EXPECT_FALSE(computed_event(event, curve).is_there);
}

TEST(CurveEvents, ThatAreNotThereGoOverIntoThoseThatAre) {
  // A fall that becomes too small stays where it is; a jump that leaves the curve is at its end.
  SampledCurve curve = curve_with(6.0);
  MeasuredEvent event = jump_measured_at(5.0, 0.1);
  event.least_fall = 0.6;
  EXPECT_FALSE(computed_event(event, curve).is_there);
  EXPECT_NEAR(computed_event(event, curve).displacement, 6.0 + step / 2, 1e-9);
  event.least_fall = 0.1;
  const ComputedEvent late = computed_event(event, curve_with(10.05)), gone = computed_event(event, curve_with(12.0));
  EXPECT_TRUE(late.is_there);
  EXPECT_FALSE(gone.is_there);
  EXPECT_NEAR(gone.displacement, late.displacement, 2.0 * step);
  EXPECT_NEAR(gone.force_before, late.force_before, 2.0 * step);
}

TEST(CurveEvents, HaveNoGreatestForceWhereItStillRises) {
  const MeasuredEvent event{.kind = EventKind::greatest_force, .place = 8.0};
  const SampledCurve curve = curve_with(12.0);
  EXPECT_FALSE(computed_event(event, curve).is_there);
  EXPECT_EQ(computed_event(event, curve).of(EventFigure::force), curve.y.back());
  EXPECT_TRUE(computed_event(event, curve_with(6.0)).is_there);
  EXPECT_FALSE(computed_event(event, up_to(curve_with(6.0), 5.5)).is_there);
}

TEST(CurveEvents, LieInAStepWhereverTheyAre) {
  const SampledCurve curve{.name = "", .x = {0, 1, 3, 3, 7}, .y = {0, 1, 3, 2, 5}};
  EXPECT_EQ(step_at(curve, -1.0), 1.0);
  EXPECT_EQ(step_at(curve, 1.5), 2.0);
  EXPECT_EQ(step_at(curve, 5.0), 4.0);
  EXPECT_EQ(step_at(curve, 7.0), 4.0);
  EXPECT_EQ(step_at(curve, 9.0), 4.0);
}

TEST(CurveEvents, HoldTheFirstDebondingWithWhatTheSetUpAdds) {
  SampledCurve curve = curve_with(12.0);
  const MeasuredEvent event{.kind = EventKind::first_debonding, .place = 4.0};
  EXPECT_FALSE(computed_event(event, curve).is_there);
  EXPECT_EQ(computed_event(event, curve).displacement, curve.x.back());
  curve.first_debonding = static_cast<std::size_t>(std::ranges::lower_bound(curve.x, 4.0 - 1e-9) - curve.x.begin());
  const ComputedEvent computed = computed_event(event, curve);
  EXPECT_NEAR(computed.displacement, 4.05, 1e-9);
  EXPECT_NEAR(computed.step, 0.1, 1e-12);
  EXPECT_NEAR(computed.force_after, 4.1, 1e-9);
  const pfdm::SetUp set_up{.offset = 1.0, .force_offset = 2.0, .compliance = 0.5};
  const ComputedEvent recorded = computed_event(event, as_recorded(curve, set_up));
  EXPECT_NEAR(recorded.displacement, 1.0 + 1.5 * 4.05, 1e-9);
  EXPECT_NEAR(recorded.force_before, 6.0, 1e-9);
  EXPECT_TRUE(computed_event(event, up_to(curve, 4.2)).is_there);
  EXPECT_FALSE(computed_event(event, up_to(curve, 4.05)).is_there);
}

// The followed curve falls back from 2 to 1 and comes back to 2 at a force of 1.5. What debonds on the way debonds, in
// the test, in the drop at 2.
TEST(CurveEvents, HoldTheFirstDebondingOfACurveThatFallsBack) {
  for (const std::size_t row : {1, 2}) {
    SampledCurve followed{.name = "", .x = {0, 2, 1, 3, 4}, .y = {0, 4, 1, 2, 3}};
    followed.first_debonding = row;
    const ComputedEvent computed = computed_event({.kind = EventKind::first_debonding}, driven_curve(followed));
    EXPECT_TRUE(computed.is_there);
    EXPECT_EQ(computed.displacement, 2.0);
    EXPECT_EQ(computed.force_before, 4.0);
    EXPECT_EQ(computed.force_after, 1.5);
  }
  SampledCurve ended{.name = "", .x = {0, 2, 1}, .y = {0, 4, 1}, .first_debonding = 1};
  EXPECT_FALSE(computed_event({.kind = EventKind::first_debonding}, driven_curve(ended)).is_there);
}

TEST(CurveEvents, MoveTheJumpAndNothingElse) {
  for (const double place : {5.03, 6.87}) {
    const SampledCurve model = curve_with(6.0),
                       moved = with_jumps_as_measured(model, {jump_measured_at(place, 0.1)}, 0);
    for (const double x : {0.5, 3.0, 5.0}) EXPECT_NEAR(moved.at(x), x, 1e-9);
    EXPECT_NEAR(moved.at(place - 1e-6), place, 1e-5);
    for (const double x : {place + 1e-6, 7.0, 9.0}) EXPECT_NEAR(moved.at(x), 3.0 + 0.5 * (x - 6.0), 1e-5);
    EXPECT_TRUE(std::ranges::is_sorted(moved.x));
    EXPECT_EQ(moved.x.back(), model.x.back());
  }
}

/// With a second jump, of 3, at 8.
SampledCurve curve_with_two() {
  SampledCurve curve = curve_with(6.0);
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (curve.x[i] > 8.0 + 1e-9) curve.y[i] -= fall;
  return curve;
}

TEST(CurveEvents, PartTheCurveWhereItHasThem) {
  const MeasuredEvent near = jump_measured_at(5.0, 0.1), other = jump_measured_at(8.5, 0.1);
  const SampledCurve both = with_jumps_as_measured(curve_with_two(), {near, other}, 0),
                     one = with_jumps_as_measured(curve_with(6.0), {near, other}, 0);
  EXPECT_NEAR(both.at(5.5), 2.75, 1e-6);
  EXPECT_NEAR(both.at(8.4), 4.2, 1e-6);
  EXPECT_NEAR(both.at(8.6), 1.3, 1e-6);
  // The second one has become too small: the first is parted all the same, and it cannot be both.
  EXPECT_NEAR(one.at(5.5), 2.75, 1e-6);
  EXPECT_NEAR(one.at(8.6), 4.3, 1e-6);
  EXPECT_FALSE(has_jumps_in_order(curve_with(6.0), {near, other}, 0));
  EXPECT_TRUE(has_jumps_in_order(curve_with_two(), {near, other}, 0));
  EXPECT_TRUE(has_jumps_in_order(curve_with(6.0), {near}, 0));
  MeasuredEvent second = other;
  second.number = 2;
  EXPECT_TRUE(has_jumps_in_order(curve_with(6.0), {near, second}, 0));
  EXPECT_EQ(with_jumps_as_measured(curve_with(6.0), {near}, 1).x, curve_with(6.0).x);
}

MeasuredPoints points_with(const MeasuredEvent& event) {
  SampledCurve data = curve_with(6.0);
  data.deviation.assign(data.x.size(), 0.05);
  MeasuredPoints points = points_between(std::vector{data}, 0.0, 10.0);
  points.events = {event};
  return points;
}

TEST(CurveEvents, CountBehindThePointsAndInPlaceOfThoseBesideThem) {
  MeasuredEvent event = jump_measured_at(6.05, 0.06);
  event.figures.push_back({EventFigure::force_before, 6.1, 0.2});
  event.figures.push_back({EventFigure::force_after, 3.0, 0.2, false});
  MeasuredPoints points = points_with(event);
  const std::size_t all = points.points.size();
  leave_out_rows_of_events(points);
  EXPECT_EQ(all - points.points.size(), 4u);  // within 0.18
  const auto residuals = residuals_of(curve_with(6.3), points).value();
  ASSERT_EQ(residuals.size(), points.points.size() + 2);
  EXPECT_NEAR(residuals[residuals.size() - 2], 0.3 / 0.06, 1e-6);
  EXPECT_NEAR(residuals.back(), 0.2 / 0.2, 1e-6);
  // Rows on the measured side of the jump are compared with that side of the computed one.
  const double after = 0.5 * 0.3;  // by which the computed branch lies higher
  for (std::size_t i = 0; i < points.points.size(); ++i)
    EXPECT_NEAR(residuals[i], points.points[i].x < 6.05 ? 0.0 : after / 0.05, 1e-6) << points.points[i].x;
}

// By what the residuals change with the place of the computed jump, that of the branches is known: 0 before, half of it
// behind. A hole of left out rows makes the means about its neighbours wide.
TEST(CurveEvents, HaveDerivativesOfTheBranchesBesideThem) {
  MeasuredPoints points = points_with(jump_measured_at(6.05, 0.06));
  leave_out_rows_of_events(points);
  const auto here = averaged_residuals_of({curve_with(6.3)}, points).value(),
             there = averaged_residuals_of({curve_with(6.4)}, points).value();
  for (std::size_t i = 0; i < points.points.size(); ++i)
    EXPECT_NEAR((there[i] - here[i]) * 0.05 / 0.1, points.points[i].x < 6.05 ? 0.0 : 0.5, 1e-6) << points.points[i].x;
}

// A point that lies as near to the jump as the differences for the slope are long.
TEST(CurveEvents, LeaveTheSlopesOfTheBranchesToErrorsOfTheSetUp) {
  MeasuredPoints points = points_with(jump_measured_at(6.05, 0.001));
  points.points = {{0, 6.04, 6.04, 0.05}, {0, 6.06, 3.0, 0.05}};
  const auto by_displacement = set_up_errors(curve_with(6.0), points)[1];
  EXPECT_NEAR(by_displacement[0] * 0.05, 1.0, 1e-6);
  EXPECT_NEAR(by_displacement[1] * 0.05, 0.5, 1e-6);
}

/// Largest second difference of the sum of squares over the place of the computed jump, of its range.
double roughness_of(const MeasuredPoints& points) {
  std::vector<double> squares;
  for (int i = 0; i <= 60; ++i) {
    squares.push_back(0.0);
    const auto residuals = residuals_of(curve_with(5.6 + 0.013 * i), points);
    for (const double r : residuals.value()) squares.back() += r * r;
  }
  double most = 0.0;
  for (std::size_t i = 1; i + 1 < squares.size(); ++i)
    most = std::max(most, std::abs(squares[i - 1] - 2.0 * squares[i] + squares[i + 1]));
  return most / (std::ranges::max(squares) - std::ranges::min(squares));
}

// Pointwise the sum of squares is a staircase in the place of the jump; with the event it is a parabola.
TEST(CurveEvents, MakeTheSumOfSquaresSmooth) {
  MeasuredPoints with = points_with(jump_measured_at(6.05, 0.1));
  std::erase_if(with.points, [](const auto& point) { return std::fmod(point.x + 1e-6, 0.5) > 0.01; });
  MeasuredPoints without = with;
  without.events.clear();
  leave_out_rows_of_events(with);
  EXPECT_LT(roughness_of(with), 0.02);
  EXPECT_GT(roughness_of(without), 0.15);
}

}  // namespace
}  // namespace pfdm::this_file
