#include "physics/error.h"
#include "postproc/curves/measured_curve.h"
#include "postproc/curves/record_faults.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace pfdm::test::this_file {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SampledCurve curve(std::vector<double> x, std::vector<double> y, std::vector<double> deviation = {}) {
  return {.name = "one", .x = std::move(x), .y = std::move(y), .deviation = std::move(deviation)};
}

std::string complaint(const SampledCurve& recorded, const Preparation& preparation) {
  return message_of<InputError>([&] { prepared(recorded, preparation, {}); });
}

// The closed form of isotonic regression: the largest of the least means (Robertson, Wright, Dykstra 1988).
TEST(MeasuredCurve, NearestDisplacementsAreThoseOfTheMinimaxFormula) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> noise(0.0, 1.5);
    std::vector<double> x;
    x.reserve(40);
    for (int i = 0; i < 40; ++i) x.push_back(0.5 * i + noise(engine));
    const std::vector<double> found = nearest_not_falling(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      double largest = -1e300;
      for (std::size_t j = 0; j <= i; ++j) {
        double least = 1e300,
               sum = std::accumulate(x.begin() + static_cast<long>(j), x.begin() + static_cast<long>(i), 0.0);
        for (std::size_t k = i; k < x.size(); ++k) {
          sum += x[k];
          least = std::min(least, sum / static_cast<double>(k - j + 1));
        }
        largest = std::max(largest, least);
      }
      EXPECT_NEAR(found[i], largest, 1e-12) << i;
    }
  }
}

TEST(MeasuredCurve, LeavesARisingRecordAsItIs) {
  const SampledCurve recorded = curve({0, 1, 1, 2}, {0, 1, 2, 3}, {1, 1, 1, 1});
  const MeasuredCurve measured = prepared(recorded, {.envelope = true, .jitter = 0.5}, {});
  EXPECT_EQ(measured.curve.x, recorded.x);
  EXPECT_EQ(measured.of_specimen().y, recorded.y);
  EXPECT_EQ(measured.curve.deviation, recorded.deviation);
  EXPECT_THAT(measured.treatment(), IsEmpty());
}

TEST(MeasuredCurve, RefusesDisplacementsThatFallAndNamesTheKeys) {
  const SampledCurve recorded = curve({0, 1, 2, 1.5, 3}, {0, 1, 2, 1.4, 3});
  EXPECT_THAT(complaint(recorded, {}),
              HasSubstr("the displacements decrease, first from row 3 (2 m) to the next (1.5 m)"));
  EXPECT_THAT(complaint(recorded, {}), HasSubstr("set loops = \"envelope\" to leave unloading out, or jitter"));
  EXPECT_THAT(complaint(recorded, {.jitter = 0.2}), HasSubstr("a jitter of 200 mm does not cover moves of 250 mm"));
  EXPECT_THAT(prepared(recorded, {.jitter = 0.25}, {}).curve.x, ElementsAre(0, 1, 1.75, 1.75, 3));
}

TEST(MeasuredCurve, NamesTheSignOfARecordThatGoesDown) {
  const SampledCurve recorded = curve({0, -1, -2, -2.9, -2.8, -4}, {0, -1, -2, -3, -2.9, -4});
  for (const Preparation& preparation : {Preparation{}, {.envelope = true}, {.jitter = 0.2}})
    EXPECT_THAT(complaint(recorded, preparation),
                HasSubstr("go down, from 0 to -4 m: their sign is not the model's; factor = -1"));
  EXPECT_THAT(complaint(curve({0, 1, 2, -4}, {0, 1, 2, -4}), {}), HasSubstr("the displacements decrease"));
}

TEST(MeasuredCurve, EnvelopeLeavesLoopsOutAndKeepsJitter) {
  //                         loop, closed          jitter     loop, to the end
  const SampledCurve recorded =
      curve({0, 1, 2, 1.2, 0.8, 1.5, 2.1, 3, 2.95, 3.05, 4, 3, 2},
            {0, 1, 2, 1.1, 0.7, 1.4, 2.1, 3, 2.95, 3.05, 4, 3, 2}, std::vector<double>(13, 0.1));
  const MeasuredCurve measured = prepared(recorded, {.envelope = true, .jitter = 0.1}, {});
  EXPECT_THAT(measured.curve.y, ElementsAre(0, 1, 2, 2.1, 3, 2.95, 3.05, 4));
  EXPECT_THAT(measured.curve.x, ElementsAre(0, 1, 2, 2.1, 2.975, 2.975, 3.05, 4));
  EXPECT_EQ(measured.curve.deviation.size(), 8u);
  EXPECT_EQ(measured.as_recorded.x.size(), 13u);
  ASSERT_EQ(measured.treatment().size(), 2u);
  EXPECT_EQ(measured.treatment()[0], "unloading loops: 5 of 13 rows left out");
  EXPECT_THAT(measured.treatment()[1], HasSubstr("jitter: 2 of 8 displacements moved, by 25 mm at most"));
}

/// A toe up to a force of 2, then straight, 5 per displacement from 1.5 on, and softer above 12.
SampledCurve curve_with_toe() {
  SampledCurve recorded{.name = "one", .x = {}, .y = {}};
  for (int i = 0; i <= 80; ++i) {
    const double u = 0.05 * i, straight = 5.0 * (u - 1.5);
    recorded.x.push_back(u);
    recorded.y.push_back(straight < 2.0 ? 2.0 * std::pow(u / 1.9, 4)
                                        : std::min(straight, 12.0 + 0.1 * (straight - 12.0)));
  }
  return recorded;
}

TEST(MeasuredCurve, ToeIsCompensatedByTheStraightPart) {
  for (const Toe& toe : {Toe{.from = 3.0, .to = 11.0}, Toe{.from = 2.1, .to = 3.7, .of_force = false}}) {
    const MeasuredCurve measured = prepared(curve_with_toe(), {.toe = toe}, {});
    EXPECT_NEAR(measured.origin, 1.5, 1e-9);
    ASSERT_FALSE(measured.curve.x.empty());
    EXPECT_NEAR(measured.curve.x.front(), measured.curve.y.front() / 5.0, 1e-12);
    EXPECT_NEAR(measured.curve.x.back(), 4.0 - 1.5, 1e-12);
    EXPECT_THAT(measured.treatment()[0], HasSubstr("5 N/m, meets zero force at 1.5 m"));
  }
  // An offset of the force moves the zero: 2 N are 0.4 m here.
  const MeasuredCurve lifted = prepared(curve_with_toe(), {.toe = Toe{.from = 3.0, .to = 11.0}}, {.force_offset = 2.0});
  EXPECT_NEAR(lifted.of_specimen().x.front(), lifted.of_specimen().y.front() / 5.0, 1e-12);
  EXPECT_THAT(complaint(curve_with_toe(), {.toe = Toe{.from = 30.0, .to = 40.0}}),
              HasSubstr("toe: 0 rows lie between"));
}

/// `length` of displacement at zero force, then 5 per displacement up to 10, then softer; with noise of the force.
SampledCurve curve_with_slack(double length, double noise, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, noise);
  SampledCurve recorded{.name = "one", .x = {}, .y = {}};
  for (int i = 0; i <= 100; ++i) {
    const double u = 0.05 * i, straight = 5.0 * std::max(0.0, u - length);
    recorded.x.push_back(u);
    recorded.y.push_back(std::min(straight, 10.0 + 0.1 * (straight - 10.0)) + normal(engine));
  }
  return recorded;
}

TEST(MeasuredCurve, SlackIsFoundAndItsLength) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto slack = slack_at_start(curve_with_slack(1.02, 0.03, seed));
    ASSERT_TRUE(slack);
    EXPECT_EQ(slack->n_rows, 21u);
    EXPECT_DOUBLE_EQ(slack->until, 1.0);
    EXPECT_NEAR(slack->origin, 1.02, 3.0 * slack->error);
    EXPECT_LT(slack->error, 0.02);
    const SampledCurve with_toe =
        prepared(curve_with_slack(1.02, 0.03, seed), {.toe = Toe{.from = slack->from, .to = slack->to}}, {}).curve;
    EXPECT_FALSE(slack_at_start(with_toe));
    EXPECT_FALSE(slack_at_start(prepared(curve_with_slack(1.02, 0.03, seed), {}, {.offset = 1.02}).of_specimen()));
    EXPECT_FALSE(slack_at_start(curve_with_slack(0.0, 0.03, seed)));
    EXPECT_FALSE(slack_at_start(curve_with_slack(0.02, 0.03, seed)));  // no row in it but the first
  }
  EXPECT_FALSE(slack_at_start(curve_with_toe()));
  const auto doubt = doubt_of_origin(curve_with_slack(1.02, 0.0, 1), curve({0, 5}, {0, 25}), 0.0, 5.0);
  ASSERT_TRUE(doubt);
  EXPECT_THAT(*doubt, HasSubstr("one begins with slack: 21 rows up to 1 m are at zero force"));
  EXPECT_THAT(*doubt, HasSubstr("meets it at 1.02 m"));
}

// A soft machine on a bar that softens: u = F/5 + 0.3 F + 0.2 before the peak.
TEST(MeasuredCurve, SetUpIsTakenOffAndPutOn) {
  const SampledCurve specimen = curve({0, 1, 2, 3, 4}, {0, 5, 10, 6, 1});
  const pfdm::SetUp set_up{.offset = 0.2, .force_offset = 0.5, .compliance = 0.1};
  const SampledCurve recorded = as_recorded(specimen, set_up);
  for (const double u : {0.5, 1.0, 1.7, 2.0, 2.5, 3.5})
    EXPECT_NEAR(recorded.at(u + 0.2 + 0.1 * specimen.at(u)), specimen.at(u) + 0.5, 1e-12) << u;
  EXPECT_NEAR(recorded.at(0.2 - 0.15), 0.5 - 0.5, 1e-12);  // straight on before its beginning
  SampledCurve measured{.name = "one", .x = {}, .y = {}};
  for (std::size_t i = 1; i < recorded.x.size(); ++i) {
    measured.x.push_back(recorded.x[i]);
    measured.y.push_back(recorded.y[i]);
  }
  const SampledCurve back = prepared(measured, {}, set_up).of_specimen();
  for (std::size_t i = 0; i < back.x.size(); ++i) {
    EXPECT_NEAR(back.x[i], specimen.x[i], 1e-12);
    EXPECT_NEAR(back.y[i], specimen.y[i], 1e-12);
  }
  EXPECT_EQ(as_recorded(specimen, {}).x, specimen.x);
}

TEST(MeasuredCurve, OfASoftMachineDropsWhereTheSpecimenSnaps) {
  const SampledCurve recorded = as_recorded(curve({0, 1, 1.5, 4}, {0, 10, 2, 1}), {.compliance = 0.1});
  EXPECT_TRUE(std::ranges::is_sorted(recorded.x));
  EXPECT_NEAR(recorded.at(1.999), 9.995, 1e-2);
  EXPECT_LT(recorded.at(2.001), 2.0);
}

// Against the textbook formulas with sums, written out.
TEST(MeasuredCurve, StraightLineIsThatOfTheTextbook) {
  const std::vector<double> x{1, 2, 3, 4, 5}, y{2.1, 3.9, 6.2, 7.8, 10.1};
  const auto line = straight_line(x, y, 0.0);
  ASSERT_TRUE(line);
  const double slope = (5 * (2.1 + 7.8 + 18.6 + 31.2 + 50.5) - 15 * 30.1) / (5 * 55.0 - 225.0);
  const double intercept = (30.1 - slope * 15) / 5;
  EXPECT_NEAR(line->slope, slope, 1e-12);
  EXPECT_NEAR(line->zero, -intercept / slope, 1e-12);
  EXPECT_FALSE(straight_line({1, 1, 1}, {1, 2, 3}, 0.0));
  EXPECT_FALSE(straight_line({1, 2}, {1, 2}, 0.0));
  EXPECT_FALSE(straight_line({1, 2, 3}, {3, 2, 1}, 0.0));
}

// The standard error of the origin is its scatter over many noises; a straight part through the origin raises few
// alarms.
TEST(MeasuredCurve, MissedOriginsAreFoundAndOthersAreNot) {
  const SampledCurve model = curve({0, 100}, {0, 500});
  int alarms = 0, found = 0;
  std::vector<double> zeros;
  double error = 0.0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 2.0);
    SampledCurve right = curve({}, {}), late = curve({}, {});
    for (int i = 0; i <= 15; ++i) {
      const double f = noise(engine);
      right.x.push_back(i);
      right.y.push_back(5.0 * i + f);
      late.x.push_back(i);
      late.y.push_back(5.0 * (i - 1.5) + f);
    }
    alarms += missed_origin(right, model, 0, 15).has_value();
    const auto missed = missed_origin(late, model, 0, 15);
    found += missed.has_value();
    const auto line = straight_line(late.x, late.y, 0.0);
    zeros.push_back(line->zero);
    error += line->zero_error / 1000.0;
  }
  EXPECT_LE(alarms, 4);
  EXPECT_GE(found, 990);
  const double mean = std::accumulate(zeros.begin(), zeros.end(), 0.0) / 1000.0;
  double scatter = 0.0;
  for (const double zero : zeros) scatter += std::pow(zero - mean, 2) / 999.0;
  EXPECT_NEAR(mean, 1.5, 0.02);
  EXPECT_NEAR(error / std::sqrt(scatter), 1.0, 0.1);
}

}  // namespace
}  // namespace pfdm::test::this_file
