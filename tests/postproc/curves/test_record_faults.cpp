// Faults of a record that a computed curve shows.

#include "physics/error.h"
#include "postproc/curves/record_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

/// Force of a bar that is elastic up to 20 N at 20 m, and softens to zero at 100 m.
double bar(double u) { return u <= 20.0 ? u : std::max(0.0, 0.25 * (100.0 - u)); }

SampledCurve bar_curve() {
  SampledCurve curve{.name = "bar", .x = {}, .y = {}};
  for (int i = 0; i <= 120; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(bar(i));
  }
  return curve;
}

/// Every `spacing`, later by `offset`, times `factor`, with noise of 0.4 N.
MeasuredCurve record(double spacing, double offset, double factor, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, 0.4);
  MeasuredCurve measured;
  measured.curve.name = "record";
  for (double u = 0.0; u + offset <= 120.0; u += spacing) {
    measured.curve.x.push_back(u + offset);
    measured.curve.y.push_back(factor * (bar(u) + noise(engine)));
  }
  return measured;
}

MeasuredPoints points_of(const MeasuredCurve& measured, double to = 120.0) {
  return points_between({measured.curve}, 0.0, to);
}

TEST(RecordFaults, ForcesOfTheOtherSignAreRefusedWithTheFactorThatTurnsThem) {
  MeasuredCurve turned = record(1.0, 0.0, -1.0, 1);
  turned.force_factor = 2.0;
  try {
    require_same_sign({bar_curve()}, points_of(turned), {turned});
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the forces of \"record\" have the other sign"));
    EXPECT_THAT(error.what(), HasSubstr("force = { ..., factor = -2 }"));
  }
}

// Slack below zero by the noise, which is all that an elastic stage has of a late record, tells no sign.
TEST(RecordFaults, NoiseTellsNoSign) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const MeasuredCurve late = record(6.0, 15.0, 1.0, seed);
    EXPECT_NO_THROW(require_same_sign({bar_curve()}, points_of(late, 15.0), {late}));
    EXPECT_NO_THROW(require_same_sign({bar_curve()}, points_of(late), {late}));
  }
}

TEST(RecordFaults, ForcesInAnotherUnitAreNamed) {
  const MeasuredCurve in_kilonewton = record(1.0, 0.0, 1e-3, 1), right = record(1.0, 0.0, 3.0, 1);
  const auto doubts = doubts_of_unit({bar_curve()}, points_of(in_kilonewton), {in_kilonewton});
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_THAT(doubts.front(), HasSubstr("the forces of record are 0.001 times the computed ones"));
  EXPECT_THAT(doubts.front(), HasSubstr("factor"));
  EXPECT_TRUE(doubts_of_unit({bar_curve()}, points_of(right), {right}).empty());
}

TEST(RecordFaults, TwoRowsOfARiseTellAnOffset) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const MeasuredCurve late = record(6.0, 15.0, 1.0, seed);
    const auto doubt = doubt_of_rise({late}, 0, bar_curve(), 0.4);
    ASSERT_TRUE(doubt);
    EXPECT_THAT(*doubt, HasSubstr("behind that of the computed curve"));
    EXPECT_THAT(*doubt, HasSubstr("key = \"experiment.specimens[0].offset\""));
    EXPECT_LT(doubt->size(), 300u);
  }
}

TEST(RecordFaults, RightRisesRaiseNoAlarm) {
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const MeasuredCurve right = record(seed % 2 == 0 ? 6.0 : 1.0, 0.0, 1.0, seed);
    EXPECT_FALSE(doubt_of_rise({right}, 0, bar_curve(), 0.4)) << seed;
  }
}

TEST(RecordFaults, SpecimensThatDisagreeAreNamedAndAnErrorOfTheModelIsNot) {
  const std::vector<MeasuredCurve> specimens{record(1.0, 0.0, 1.1, 1), record(1.0, 0.0, 0.9, 2)},
      alike{record(1.0, 0.0, 1.1, 1), record(1.0, 0.0, 1.1, 2)};
  const auto doubt = [](const std::vector<MeasuredCurve>& two) {
    const MeasuredPoints points = points_between({two[0].curve, two[1].curve}, 0.0, 120.0);
    return doubt_of_specimens(*residuals_of(bar_curve(), points), points, two);
  };
  ASSERT_TRUE(doubt(specimens));
  EXPECT_THAT(*doubt(specimens), HasSubstr("the specimens disagree"));
  EXPECT_FALSE(doubt(alike));
}

TEST(RecordFaults, RowsThatRunBackwardsAreNamed) {
  SampledCurve backwards = bar_curve();
  std::ranges::reverse(backwards.x);
  std::ranges::reverse(backwards.y);
  try {
    prepared(backwards, {.jitter = 0.5}, {});
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the rows run backwards; sort the file by displacement"));
  }
}

}  // namespace
}  // namespace pfdm::this_file
