// Spread and drift over a schedule, against values that are known.

#include "solver/vibration/diagnosis/repeatability.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

constexpr double g0 = 9.80665;
constexpr double day = 86400.0;

/// Three sweeps at each of two levels a day: low, low, high, high, low, high.
std::vector<ScheduledRun> schedule(const std::vector<double>& ages) {
  std::vector<ScheduledRun> runs;
  const double levels[] = {1.0, 1.0, 2.0, 2.0, 1.0, 2.0};
  for (const double age : ages)
    for (int run = 1; run <= 6; ++run) runs.push_back({levels[run - 1] * g0, age * day, run});
  return runs;
}

double slope(const Repeatability& r, const std::string& name) {
  for (const Effect& e : r.effects)
    if (e.name == name) return e.value;
  return std::nan("");
}

TEST(Repeatability, FindsSlopesWithoutScatter) {
  const auto runs = schedule({7.0, 14.0, 35.0});
  std::vector<double> values;
  values.reserve(runs.size());
  for (const ScheduledRun& r : runs) values.push_back(100.0 - 3.0 * r.level / g0 + 0.2 * r.age / day + 0.1 * r.run);
  const Repeatability found = repeatability(runs, values);
  EXPECT_NEAR(slope(found, "per_g0"), -3.0, 1e-10);
  EXPECT_NEAR(slope(found, "per_day"), 0.2, 1e-10);
  EXPECT_NEAR(slope(found, "per_run"), 0.1, 1e-10);
  EXPECT_NEAR(found.mean, 100.0 - 4.5 + 0.2 * 56.0 / 3.0 + 0.35, 1e-10);
  EXPECT_EQ(found.residual_freedom, 14);
  EXPECT_LT(found.residual_deviation, 1e-10);
  // Runs 1, 2, 5 and 3, 4, 6 of a day are alike; between them only the run's number moves the value.
  EXPECT_EQ(found.repeat_freedom, 12);
  const double about_8_3 = 26.0 / 3.0, about_13_3 = 14.0 / 3.0;  // sums of squares
  EXPECT_NEAR(*found.repeat_deviation, 0.1 * std::sqrt(3.0 * (about_8_3 + about_13_3) / 12.0), 1e-10);
}

// Of many schedules with known scatter, 95 % of the intervals hold the truth, and the deviations are the scatter's.
TEST(Repeatability, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const auto runs = schedule({7.0, 14.0, 35.0});
  constexpr int trials = 600;
  int held = 0;
  double repeat = 0.0, residual = 0.0;
  for (int trial = 1; trial <= trials; ++trial) {
    const Eigen::VectorXd noise = normal_numbers(static_cast<Eigen::Index>(runs.size()), 77 + trial);
    std::vector<double> values;
    for (std::size_t i = 0; i < runs.size(); ++i) values.push_back(5.0 + 0.01 * runs[i].age / day + 0.3 * noise[i]);
    const Repeatability found = repeatability(runs, values);
    const Effect& e = found.effects[1];
    ASSERT_EQ(e.name, "per_day");
    held += e.lower_95 <= 0.01 && 0.01 <= e.upper_95;
    repeat += *found.repeat_deviation * *found.repeat_deviation / trials;
    residual += found.residual_deviation * found.residual_deviation / trials;
  }
  EXPECT_GT(held, 0.925 * trials);
  EXPECT_LT(held, 0.975 * trials);
  EXPECT_NEAR(std::sqrt(repeat), 0.3, 0.01);
  EXPECT_NEAR(std::sqrt(residual), 0.3, 0.01);
}

TEST(Repeatability, LeavesOutWhatDidNotVary) {
  std::vector<ScheduledRun> runs;
  for (int run = 1; run <= 4; ++run) runs.push_back({g0, 7.0 * day, run});
  const Repeatability found = repeatability(runs, std::vector{1.0, 2.0, 3.0, 4.0});
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "per_run");
  EXPECT_NEAR(found.effects[0].value, 1.0, 1e-12);
}

TEST(Repeatability, TellsWhatAScheduleCannotTellApart) {
  EXPECT_FALSE(confounded(schedule({7.0, 14.0})));
  const std::vector<ScheduledRun> one_a_day{{g0, 1 * day, 1}, {g0, 2 * day, 2}, {g0, 3 * day, 3}};
  EXPECT_EQ(confounded(one_a_day), "age, run");
}

TEST(Repeatability, GivesNoIntervalsWithoutDegreesOfFreedom) {
  const std::vector<ScheduledRun> runs{{g0, 1 * day, 1}, {g0, 2 * day, 1}};
  const Repeatability found = repeatability(runs, std::vector{1.0, 3.0});
  EXPECT_NEAR(slope(found, "per_day"), 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(found.effects[0].lower_95));
  EXPECT_FALSE(found.repeat_deviation);
}

}  // namespace
}  // namespace pfdm::this_file
