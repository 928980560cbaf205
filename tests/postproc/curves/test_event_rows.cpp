#include "postproc/curves/event_rows.h"

#include "physics/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using testing::ElementsAre;

/// Rows at 0, 1 ... 20, each with a standard deviation of 0.2.
MeasuredPoints points_with(const MeasuredEvent& event) {
  MeasuredPoints points{.points = {}, .noise_is_known = true, .rms = 1.0, .events = {event}};
  for (int i = 0; i <= 20; ++i) points.points.push_back({0, static_cast<double>(i), 1.0, 0.2});
  return points;
}

/// The rows that are left out.
std::vector<double> left_out(const MeasuredEvent& event) {
  const MeasuredPoints all = points_with(event);
  MeasuredPoints points = all;
  leave_out_rows_of_events(points);
  std::vector<double> rows;
  for (const auto& point : all.points)
    if (std::ranges::count(points.points, point.x, &MeasuredPoints::Point::x) == 0) rows.push_back(point.x);
  EXPECT_EQ(points.left_out, rows.size());
  return rows;
}

TEST(EventRows, MayBeOnTheWrongSideOfAJump) {
  MeasuredEvent event{.place = 10.5, .figures = {{EventFigure::displacement, 10.5, 0.4}}};
  EXPECT_THAT(left_out(event), ElementsAre(10.0, 11.0));
  event.specimen = 1;
  EXPECT_THAT(left_out(event), ElementsAre());
}

// Where something debonds, or the force is the greatest, the curve has two sides that are the same.
TEST(EventRows, AreKeptWhereTheCurveDoesNotJump) {
  for (const EventKind kind : {EventKind::greatest_force, EventKind::first_debonding})
    EXPECT_THAT(left_out({.kind = kind, .place = 10.5, .figures = {{EventFigure::displacement, 10.5, 2.0}}}),
                ElementsAre());
}

// A force that was read off a row has the row's standard deviation, one by a line through four half of it.
TEST(EventRows, AreDataOfAStatedForceAlready) {
  MeasuredEvent event{.place = 10.5, .figures = {{EventFigure::displacement, 10.5, 0.01}}};
  event.figures.push_back({EventFigure::force_before, 1.0, 0.2});
  EXPECT_THAT(left_out(event), ElementsAre(10.0));
  event.figures.back() = {EventFigure::force_after, 1.0, 0.1};
  EXPECT_THAT(left_out(event), ElementsAre(11.0, 12.0, 13.0, 14.0));
  event.figures.back().counts = false;
  EXPECT_THAT(left_out(event), ElementsAre());
  EXPECT_THAT(
      left_out({.kind = EventKind::greatest_force, .place = 10.0, .figures = {{EventFigure::force, 1.0, 0.12}}}),
      ElementsAre(9.0, 10.0, 11.0));
}

TEST(EventRows, AreEightOfAForceAtMost) {
  const MeasuredEvent exact{.place = 10.5, .figures = {{EventFigure::force_before, 1.0, 1e-6}}};
  EXPECT_EQ(left_out(exact).size(), 8u);
}

TEST(EventRows, AreNotAllLeftOut) {
  MeasuredPoints points = points_with({.place = 10.0, .figures = {{EventFigure::displacement, 10.0, 4.0}}});
  EXPECT_THROW(leave_out_rows_of_events(points), InputError);
}

// A force of 4 N takes 8 of the recorded 20 into the set-up, and an offset 1.
TEST(EventRows, HaveAPlaceOnTheSpecimen) {
  const MeasuredCurve measured{.curve = {.name = "", .x = {0, 20, 40}, .y = {1, 5, 9}},
                               .set_up = {.offset = 1.0, .force_offset = 1.0, .compliance = 2.0}};
  EXPECT_DOUBLE_EQ(displacement_of_specimen(measured, 20.0), 11.0);
  EXPECT_DOUBLE_EQ(displacement_of_specimen(measured, 30.0), 17.0);
}

}  // namespace
}  // namespace pfdm::this_file
