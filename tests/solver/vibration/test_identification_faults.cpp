// Faults of vibration records of an independent simulator are named.

#include "solver/vibration/identification/identification_base_noise.h"
#include "solver/vibration/identification/identification_responses.h"
#include "tests/solver/independent_simulators.h"
#include "tests/solver/judged_records.h"
#include "tests/solver/mass_material_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

class FaultyRecord : public testing::TestWithParam<bool> {
 protected:
  VibrationRecord record() const { return noisy_record(GetParam() ? "1" : "2", GetParam() ? random_motion : sweep); }
  const char* structure() const { return GetParam() ? "1" : "2"; }
  void expect_named(const VibrationRecord& spoilt, const char* name) const {
    const Judged found = judged(spoilt, structure());
    EXPECT_THAT(found.doubts, SizeIs(1));
    ASSERT_THAT(found.faults, SizeIs(1)) << name;
    EXPECT_THAT(found.faults[0], HasSubstr(name));
  }
};

TEST_P(FaultyRecord, WithOneSignReversedIsNamed) {
  VibrationRecord r = record();
  r.base = -r.base;
  expect_named(r, "the sign of one channel is reversed");
  r.base = -r.base;
  r.relative = -r.relative;
  expect_named(r, "the sign of one channel is reversed");
}

TEST_P(FaultyRecord, OfTheAbsoluteAccelerationIsNamed) {
  VibrationRecord r = record();
  r.relative += r.base;
  expect_named(r, "(absolute) acceleration");
}

TEST_P(FaultyRecord, WithASkewOfASampleIsNamed) {
  const VibrationRecord right = record();
  VibrationRecord r = right;
  r.relative.tail(r.n() - 1) = right.relative.head(r.n() - 1);
  expect_named(r, "the relative channel is 1 sample behind");
  r = right;
  r.base.tail(r.n() - 1) = right.base.head(r.n() - 1);
  expect_named(r, "the base channel is 1 sample behind");
}

// Two samples, tried by themselves, explain most of five.
TEST_P(FaultyRecord, WithASkewOfFiveSamplesIsNamed) {
  VibrationRecord r = record();
  const VibrationRecord right = r;
  r.relative.tail(r.n() - 5) = right.relative.head(r.n() - 5);
  expect_named(r, "the relative channel is 5 samples behind");
}

TEST_P(FaultyRecord, WithAHumOfTheMainsIsNamed) {
  VibrationRecord r = record();
  const double size = 0.3 * std::sqrt(r.relative.squaredNorm() / static_cast<double>(r.n()));
  for (Eigen::Index i = 0; i < r.n(); ++i)
    r.relative[i] += size * std::sin(2.0 * std::numbers::pi * 49.97 * static_cast<double>(i) / r.rate);
  const Judged found = judged(r, structure());
  ASSERT_THAT(found.faults, SizeIs(1));
  EXPECT_THAT(found.faults[0], HasSubstr("the relative channel has a hum of the mains, 49.9"));
}

TEST_P(FaultyRecord, WithASkewOfHalfASampleIsNamed) {
  VibrationRecord r = record();
  // Half a sample by the mean of neighbours, whose loss at 420 Hz is 2.4 %.
  r.relative.tail(r.n() - 1) = 0.5 * (r.relative.tail(r.n() - 1) + r.relative.head(r.n() - 1)).eval();
  expect_named(r, "the relative channel is 0.5 sample behind");
}

TEST_P(FaultyRecord, InAnotherUnitIsNamed) {
  VibrationRecord r = record();
  r.relative /= g0;
  expect_named(r, "the relative channel seems to be in another unit, g0");
  r = record();
  r.base /= g0;
  expect_named(r, "the base channel seems to be in another unit, g0");
}

TEST_P(FaultyRecord, WithItsChannelsExchangedIsNamed) {
  VibrationRecord r = record();
  r.base.swap(r.relative);
  expect_named(r, "exchanged");
}

TEST_P(FaultyRecord, ThatLacksSamplesOfOneChannelIsNamed) {
  VibrationRecord r = record();
  const Eigen::Index at = 2 * r.n() / 5, left = r.n() - 14;
  r.relative.segment(at, left - at) = r.relative.tail(left - at).eval();
  r.base.conservativeResize(left);
  r.relative.conservativeResize(left);
  expect_named(r, "14 samples of the relative channel are missing");
}

TEST_P(FaultyRecord, DeadInItsSecondHalfIsNamed) {
  VibrationRecord r = record();
  r.relative.tail(r.n() / 2).setZero();
  expect_named(r, GetParam() ? "a channel is dead from 10 to 20 s" : "a channel is dead from 3 to 6 s");
  independent::add_white_noise(r, 40.0, 2);
  expect_named(r, "a channel is dead from");
}

INSTANTIATE_TEST_SUITE_P(Under, FaultyRecord, testing::Bool(),
                         [](const auto& row) { return row.param ? "random_motion" : "a_sweep"; });

}  // namespace
}  // namespace pfdm::this_file
