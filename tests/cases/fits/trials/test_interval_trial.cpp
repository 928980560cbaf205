// An interval taken at its word, of the two values of a line: where it holds, and where the model does not converge.

#include "cases/program/session/terminal/log.h"
#include "cases/program/studies/fit/interval_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace pfdm::this_file {
namespace {

/// The trial is above a = 1.03, whose lower bound is near. y = a + b x at x = 0, 1, 2, 3, not all on a line; no answer
/// where `fails`.
FitProblem line(const std::function<bool(double a, double b)>& fails, double least_b) {
  FitProblem problem;
  problem.parameters = {{.name = "a", .unit = "", .lower = 0.8, .upper = 10.0},
                        {.name = "b", .unit = "", .lower = least_b, .upper = 10.0}};
  problem.residuals = [fails](std::span<const double> p) -> std::optional<std::vector<double>> {
    if (fails(p[0], p[1])) return std::nullopt;
    std::vector<double> r;
    for (const double y : {1.0, 2.0, 3.3, 4.0}) r.push_back(p[0] + p[1] * static_cast<double>(r.size()) - y);
    return r;
  };
  return problem;
}

std::vector<CaseParameter> names() {
  CaseParameter a, b;
  a.name = "experiment.a", b.name = "material.b";
  return {a, b};
}

struct Trial {
  std::optional<std::string> doubt;
  std::vector<std::vector<double>> told;  ///< values after every step of the trial
};
Trial trial(const std::function<bool(double, double)>& fails, double least_b = -10.0) {
  FitSettings settings;
  const FitResult found = fit(line([](double, double) { return false; }, least_b), settings);
  Trial result;
  settings.iterated = [&](const FitIteration& at) { result.told.push_back(at.parameters); };
  const FitProblem problem = line(fails, least_b);
  std::ostringstream out, err;
  Log log(out, err, false, true);
  result.doubt = doubt_of_interval({problem, settings, found, names()}, 0, log);
  return result;
}

TEST(IntervalTrial, HoldsForALine) {
  const Trial all = trial([](double, double) { return false; });
  EXPECT_FALSE(all.doubt) << *all.doubt;
  ASSERT_FALSE(all.told.empty());
  for (const std::vector<double>& values : all.told) {
    ASSERT_EQ(values.size(), 2u) << "the held one among them";
    EXPECT_DOUBLE_EQ(values[0], all.told[0][0]);
    EXPECT_GT(std::abs(values[0] - 1.04), 0.1) << "three standard errors away";
  }
}

// a = 1.03 +- 0.148; with a three standard errors above it b is 0.84 in place of 1.03, and 0.87 with two and a half.
TEST(IntervalTrial, GoesLessFarWhereAnotherMeetsItsBound) {
  const Trial nearer = trial([](double, double) { return false; }, 0.86);
  EXPECT_FALSE(nearer.doubt) << *nearer.doubt;
  ASSERT_FALSE(nearer.told.empty());
  EXPECT_NEAR(nearer.told[0][0], 1.03 + 2.5 * 0.1485, 1e-3);
}

// Residuals that grow because b is at its bound say nothing about a.
TEST(IntervalTrial, IsNoneWhereAnotherMeetsItsBoundAtOnce) {
  const Trial stopped = trial([](double, double) { return false; }, 0.95);
  ASSERT_TRUE(stopped.doubt);
  EXPECT_THAT(*stopped.doubt, ::testing::HasSubstr("the interval of experiment.a could not be tried"));
  EXPECT_THAT(*stopped.doubt, ::testing::HasSubstr("material.b is at its bound"));
  EXPECT_TRUE(stopped.told.empty());
}

// The linear model takes b below 0.9; with the estimate itself, 1.03, there is an answer.
TEST(IntervalTrial, BeginsAtTheEstimatesWhereTheLinearModelLeadsToNoAnswer) {
  bool was_refused = false;
  const Trial some = trial([&](double, double b) {
    const bool fails = b < 0.9;
    was_refused |= fails;
    return fails;
  });
  EXPECT_TRUE(was_refused);
  EXPECT_FALSE(some.doubt) << *some.doubt;
  EXPECT_FALSE(some.told.empty());
}

TEST(IntervalTrial, SaysThatThereIsNoAnswer) {
  const Trial none = trial([](double a, double) { return a > 1.3; });
  ASSERT_TRUE(none.doubt);
  EXPECT_THAT(*none.doubt, ::testing::HasSubstr("the interval of experiment.a could not be tried"));
  EXPECT_TRUE(none.told.empty());
}

}  // namespace
}  // namespace pfdm::this_file
