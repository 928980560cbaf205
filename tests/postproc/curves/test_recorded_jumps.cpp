#include "postproc/curves/recorded_jumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pfdm::this_file {
namespace {

/// Rows with a spacing of 1 of a curve that rises with slope 1 and falls by 10 at each of the places, with noise.
SampledCurve record_of(const std::vector<double>& places, double deviation, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, deviation);
  SampledCurve record{.name = "record", .x = {}, .y = {}};
  for (int i = 0; i <= 80; ++i) {
    double y = i;
    for (const double place : places)
      if (i > place) y -= 10.0;
    record.x.push_back(i);
    record.y.push_back(y + noise(engine));
  }
  record.deviation.assign(record.x.size(), deviation);
  return record;
}

TEST(RecordedJumps, LieBetweenTwoRows) {
  const auto jumps = recorded_jumps(record_of({30.2, 60.9}, 0.01, 1), 0.1);
  ASSERT_EQ(jumps.size(), 2u);
  EXPECT_NEAR(jumps[0].displacement, 30.5, 1e-6);
  EXPECT_NEAR(jumps[0].deviation, 1.0 / std::sqrt(12.0), 1e-6);
  EXPECT_NEAR(jumps[0].force_before, 30.5, 0.05);
  EXPECT_NEAR(jumps[0].force_after, 20.5, 0.05);
  EXPECT_NEAR(jumps[1].displacement, 60.5, 1e-6);
}

TEST(RecordedJumps, AreNoneInNoise) {
  int found = 0;
  for (unsigned seed = 1; seed <= 200; ++seed)
    found += static_cast<int>(recorded_jumps(record_of({}, 3.0, seed), 0.05).size());
  EXPECT_LE(found, 2);
  EXPECT_TRUE(recorded_jumps({}, 0.1).empty());
  EXPECT_TRUE(recorded_jumps({.name = "", .x = {0, 1, 2}, .y = {0, 1, 0}, .deviation = {1, 1, 1}}, 0.1).empty());
}

// Rows 40 to 60 at one displacement, and the fall in their middle: all rows about it are at the same place.
TEST(RecordedJumps, AreFoundWhereTheMachineWaits) {
  SampledCurve record = record_of({50.5}, 0.01, 1);
  for (std::size_t i = 41; i < record.x.size(); ++i) {
    const double waited = std::min(static_cast<double>(i) - 40.0, 20.0);
    record.x[i] -= waited;
    record.y[i] -= waited;
  }
  const auto jumps = recorded_jumps(record, 0.1);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_NEAR(jumps[0].displacement, 40.0, 1e-9);
  EXPECT_NEAR(jumps[0].deviation, 60.0 / 80.0 / std::sqrt(12.0), 1e-3);
}

// Of a jump that is five standard deviations of the noise, and anywhere between two rows.
TEST(RecordedJumps, AreAsFarOffAsTheySay) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(35.0, 36.0);
  double squares = 0.0, off = 0.0;
  int n = 0;
  for (unsigned seed = 1; seed <= 500; ++seed) {
    const double at = place(engine);
    const auto jumps = recorded_jumps(record_of({at}, 10.0 / 5.0, seed), 0.05);
    if (jumps.empty()) continue;
    ++n;
    double nearest = 1e9, deviation = 1.0;
    for (const RecordedJump& jump : jumps)
      if (std::abs(jump.displacement - at) < nearest) {
        nearest = std::abs(jump.displacement - at);
        deviation = jump.deviation;
      }
    squares += std::pow(nearest / deviation, 2);
    off += nearest > 2.0 * deviation ? 1.0 : 0.0;
  }
  ASSERT_GT(n, 350);
  EXPECT_NEAR(std::sqrt(squares / n), 1.0, 0.1);
  EXPECT_LT(off / n, 0.03);
}

}  // namespace
}  // namespace pfdm::this_file
