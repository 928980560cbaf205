#include "postproc/curves/curve_jumps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

/// Rises with slope 1, falls by `fall` at `place`, and so on up to 10.
SampledCurve falling_at(std::vector<double> places, double fall) {
  SampledCurve curve;
  double lost = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double x = 0.1 * i;
    if (!places.empty() && x > places.front() - 1e-9) {
      curve.x.push_back(places.front());
      curve.y.push_back(places.front() - lost);
      lost += fall;
      places.erase(places.begin());
    }
    curve.x.push_back(x + 1e-6);
    curve.y.push_back(x - lost);
  }
  return curve;
}

TEST(CurveJumps, AreFallsOfMoreThanATenth) {
  EXPECT_THAT(jumps_of(falling_at({3.05, 6.05}, 2.0)), ElementsAre(3.05, 6.05));
  EXPECT_THAT(jumps_of(falling_at({3.05}, 0.5)), IsEmpty());
  EXPECT_THAT(jumps_of({}), IsEmpty());
}

TEST(CurveJumps, AreMovedToThoseOfAnotherCurve) {
  const SampledCurve from = falling_at({3.05, 6.05}, 2.0), to = falling_at({3.55, 5.05}, 2.0);
  const SampledCurve moved = JumpAlignment(from, to)(from);
  EXPECT_THAT(jumps_of(moved), ElementsAre(DoubleNear(3.55, 1e-12), DoubleNear(5.05, 1e-12)));
  EXPECT_EQ(moved.y, from.y);
  EXPECT_EQ(moved.x.front(), from.x.front());
  EXPECT_EQ(moved.x.back(), from.x.back());
}

// A fall of 1 in 6 stands in one curve alone: with falls of a tenth the numbers of jumps differ.
TEST(CurveJumps, AreMovedByTheFallThatMakesAJump) {
  SampledCurve from = falling_at({3.05}, 2.0), to = falling_at({3.55}, 2.0);
  for (std::size_t i = 0; i < to.x.size(); ++i)
    if (to.x[i] > 7.0) to.y[i] -= 1.0;
  EXPECT_EQ(JumpAlignment(from, to)(from).x, from.x);
  EXPECT_THAT(jumps_of(JumpAlignment(from, to, 0.2)(from), 0.2), ElementsAre(DoubleNear(3.55, 1e-12)));
}

TEST(CurveJumps, StayWhereTheOtherCurveHasOthers) {
  const SampledCurve from = falling_at({3.05, 6.05}, 2.0);
  EXPECT_EQ(JumpAlignment(from, falling_at({3.05}, 2.0))(from).x, from.x);
  EXPECT_EQ(JumpAlignment(falling_at({}, 2.0), from)(from).x, from.x);
}

}  // namespace
}  // namespace pfdm::this_file
