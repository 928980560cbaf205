// Intervals and verdicts of fits to data whose noise is correlated, by repetition.

#include "postproc/fits/fit_judgement.h"
#include "tests/solver/noisy_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;

FitFindings findings(const std::string& kind, std::size_t n, std::mt19937_64& engine) {
  const FitProblem problem = noisy_bar::problem(noisy_bar::noise(kind, n, engine));
  const FitResult result = fit(problem, {.step = 1e-4});
  FitFindings found = findings_of(problem.parameters, result);
  judge(found, {.series = {{.name = "bar", .along = "displacement", .values = result.residuals}},
                .result = &result,
                .misfit = result.rms});
  return found;
}

struct Coverage {
  int sound = 0, widened = 0, questionable = 0;
  int held = 0, intervals = 0;  // of all parameters
  double share() const { return static_cast<double>(held) / static_cast<double>(intervals); }
};

Coverage coverage(const std::string& kind, std::size_t n, int repetitions) {
  Coverage all;
  std::mt19937_64 engine(7);
  for (int i = 0; i < repetitions; ++i) {
    const FitFindings found = findings(kind, n, engine);
    all.sound += found.verdict == Verdict::sound ? 1 : 0;
    all.widened += found.verdict == Verdict::correlated ? 1 : 0;
    all.questionable += found.verdict == Verdict::questionable ? 1 : 0;
    for (std::size_t j = 0; j < found.parameters.size(); ++j) {
      const FittedParameter& p = found.parameters[j];
      if (!std::isfinite(p.lower)) continue;
      ++all.intervals;
      all.held += p.lower < noisy_bar::truth[j] && noisy_bar::truth[j] < p.upper ? 1 : 0;
    }
  }
  return all;
}

TEST(CorrelatedFit, HasIntervalsThatHoldTheTruth) {
  for (const char* kind : {"ar 0.3", "ar 0.6", "ar 0.8", "steps", "mesh"}) {
    const Coverage found = coverage(kind, 200, 150);
    EXPECT_GE(found.share(), 0.87) << kind;
    EXPECT_LE(found.questionable, 15) << kind << ", of 150";
  }
  EXPECT_GE(coverage("ar 0.6", 200, 150).widened, 140);
}

TEST(CorrelatedFit, IsSoundAsItWasWhereTheNoiseIsWhite) {
  const Coverage found = coverage("white", 200, 150);
  EXPECT_GE(found.sound + found.widened, 150);
  EXPECT_GE(found.sound, 146);
  EXPECT_NEAR(found.share(), 0.95, 0.025);
}

TEST(CorrelatedFit, SaysHowMuchWiderItsIntervalsAre) {
  std::mt19937_64 engine(3);
  const FitFindings found = findings("ar 0.6", 400, engine);
  ASSERT_EQ(found.verdict, Verdict::correlated);
  EXPECT_EQ(name_of(found.verdict), "sound with correlated residuals");
  ASSERT_EQ(found.reasons.size(), 2u);
  EXPECT_THAT(found.reasons[0], HasSubstr("the residuals of bar are correlated over displacement"));
  EXPECT_THAT(found.reasons[1], HasSubstr("standard errors are widened for the correlation, by up to "));
}

// ((1 + 0.6)/(1 - 0.6))^(1/2) of parameters on which long parts of the curve depend
TEST(CorrelatedFit, WidensInTheMeanAsTheNoiseDoes) {
  std::mt19937_64 engine(4);
  double mean = 0.0;
  for (int i = 0; i < 40; ++i) mean += findings("ar 0.6", 400, engine).parameters[2].widened_by / 40.0;
  EXPECT_NEAR(mean, 2.0, 0.15);
}

// A wave over the whole curve is no noise: it does not show how far noise like it would move the estimates.
TEST(CorrelatedFit, HasNoIntervalsWhereTheResidualsAreOneWave) {
  std::vector<double> wave;
  for (int i = 0; i < 100; ++i) wave.push_back(std::sin(0.06 * i) * std::cos(0.04 * i));
  const FitProblem problem = noisy_bar::problem(wave);
  const FitResult result = fit(problem, {.step = 1e-4});
  FitFindings found = findings_of(problem.parameters, result);
  judge(found, {.series = {{.name = "bar", .along = "displacement", .values = result.residuals}}, .result = &result});
  EXPECT_EQ(found.verdict, Verdict::questionable);
  EXPECT_FALSE(std::isfinite(found.parameters[0].lower));
}

TEST(CorrelatedFit, OfTwoPointsIsNeverSound) {
  FitProblem problem;
  problem.parameters = {{.name = "slope", .unit = "", .first = 1.0, .lower = 0.1, .upper = 10.0}};
  problem.noise_is_known = true;
  problem.residuals = [](std::span<const double> p) {
    return std::optional(std::vector{p[0] - 2.0, 2.0 * p[0] - 4.1});
  };
  const FitResult result = fit(problem);
  FitFindings found = findings_of(problem.parameters, result);
  judge(found, {.series = {{.name = "line", .along = "displacement", .values = result.residuals}}, .result = &result});
  EXPECT_EQ(found.verdict, Verdict::questionable);
  ASSERT_EQ(found.reasons.size(), 1u);
  EXPECT_EQ(found.reasons[0], "2 data for 1 parameter: nothing shows whether the model fits; 4 or more are needed");
}

TEST(HoldMove, ReachesTowardsTheFinerEstimateWithinTheBounds) {
  for (const bool log_scale : {false, true}) {
    FittedParameter p{.name = "toughness", .unit = "J/m^2", .estimate = 100.0};
    p.log_scale = log_scale;
    p.lower_bound = 50.0, p.upper_bound = 115.0;
    p.moved_by_finer = 8.0;
    double lower = 95.0, upper = 105.0;
    hold_move(p, lower, upper);
    EXPECT_EQ(lower, 95.0);
    EXPECT_NEAR(upper, log_scale ? 105.0 * 1.08 : 113.0, 1e-12);
    hold_move(p, lower, upper);
    EXPECT_EQ(upper, 115.0);
    p.moved_by_finer = -60.0;
    hold_move(p, lower, upper);
    EXPECT_EQ(lower, 50.0);
    EXPECT_EQ(upper, 115.0);
  }
}

}  // namespace
}  // namespace pfdm::this_file
