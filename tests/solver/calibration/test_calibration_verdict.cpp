#include "solver/calibration/calibration_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pfdm::this_file {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<double> noise(std::size_t n, unsigned seed, double correlation = 0.0) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    const double fresh = normal(engine);
    values.push_back(i == 0 ? fresh : correlation * values.back() + std::sqrt(1.0 - correlation * correlation) * fresh);
  }
  return values;
}

/// Noise about a line whose two parameters were fitted, three curves.
FitEvidence evidence_of(unsigned seed, std::size_t n, bool known, double scale = 1.0, double correlation = 0.0) {
  FitEvidence evidence{.noise_is_known = known, .estimates = {{.name = "a"}, {.name = "b"}}};
  for (unsigned k = 0; k < 3; ++k) {
    std::vector<double> values = noise(n, 3 * seed + k, correlation);
    for (double& value : values) value *= scale;
    evidence.series.push_back({.name = "curve " + std::to_string(k + 1), .along = "time", .values = std::move(values)});
  }
  return evidence;
}

TEST(Verdict, OnRightFitsRaisesFewAlarms) {
  for (const bool known : {true, false})
    for (const std::size_t n : {20u, 100u, 1000u}) {
      int alarms = 0;
      for (unsigned seed = 1; seed <= 1000; ++seed)
        alarms += judge(evidence_of(seed, n, known, known ? 1.0 : 1e5)).verdict != Verdict::sound;
      EXPECT_LE(alarms, 10) << "of 1000, with " << n << (known ? " residuals and known noise" : " residuals");
    }
}

TEST(Verdict, CountsResidualsAgainstTheStatedNoise) {
  for (const double ratio : {1.5, 3.1}) {
    const Judgement found = judge(evidence_of(1, 100, true, ratio));
    EXPECT_EQ(found.verdict, Verdict::questionable);
    ASSERT_EQ(found.reasons.size(), 1u);
    EXPECT_THAT(found.reasons[0], HasSubstr("times the stated noise"));
  }
  EXPECT_THAT(judge(evidence_of(1, 100, false, 3.1)).reasons, IsEmpty());
  EXPECT_THAT(judge(evidence_of(1, 10000, true, 1.05)).reasons, IsEmpty());  // significant, of no consequence
}

TEST(Verdict, FindsCorrelatedResidualsInMostFits) {
  for (const bool known : {true, false}) {
    int found = 0;
    for (unsigned seed = 1; seed <= 100; ++seed)
      found += judge(evidence_of(seed, 100, known, 1.0, 0.6)).verdict == Verdict::questionable;
    EXPECT_GE(found, 99);
  }
  const Judgement found = judge(evidence_of(1, 200, false, 0.01, 0.83));
  ASSERT_FALSE(found.reasons.empty());
  EXPECT_THAT(found.reasons[0], HasSubstr("correlated over time"));
}

// Against its formula, written out, and the closed form of the distribution of 5 degrees of freedom.
TEST(Verdict, PortmanteauIsThatOfLjungAndBox) {
  std::vector<double> x;
  x.reserve(40);
  for (int i = 0; i < 40; ++i) x.push_back(std::sin(0.7 * i) + 0.5 * std::cos(2.1 * i));
  double all = 0.0, Q = 0.0;
  for (const double value : x) all += value * value;
  for (std::size_t k = 1; k <= 5; ++k) {
    double r = 0.0;
    for (std::size_t i = k; i < x.size(); ++i) r += x[i] * x[i - k] / all;
    Q += 40.0 * 42.0 * r * r / static_cast<double>(40 - k);
  }
  // P(chi^2 > Q) of 5 degrees of freedom in closed form.
  const double h = 0.5 * Q;
  const double p = std::erfc(std::sqrt(h)) +
                   2.0 / std::sqrt(std::acos(-1.0)) * std::exp(-h) * (std::sqrt(h) + 2.0 / 3.0 * std::pow(h, 1.5));
  EXPECT_NEAR(whiteness(x).probability / p, 1.0, 1e-9);
}

TEST(Verdict, TellsCorrelatedNeighboursFromAlternatingOnes) {
  std::vector<double> wave, alternating;
  for (int i = 0; i < 200; ++i) {
    wave.push_back(std::sin(0.05 * i));
    alternating.push_back(i % 2 == 0 ? 1.0 : -1.0);
  }
  EXPECT_GT(whiteness(wave).neighbours, 0.95);
  EXPECT_LT(whiteness(alternating).neighbours, -0.95);
  EXPECT_GT(whiteness(wave).inflation, 3.0);
  EXPECT_EQ(whiteness(alternating).inflation, 1.0);
}

TEST(Verdict, LeavesErrorsOfTheComputationAlone) {
  FitEvidence evidence = evidence_of(1, 200, false, 1e-6, 0.95);
  EXPECT_EQ(judge(evidence).verdict, Verdict::questionable);
  evidence.negligible = 1e-4;
  EXPECT_EQ(judge(evidence).verdict, Verdict::sound);
  EXPECT_EQ(judge(evidence_of(1, 200, true, 0.02, 0.95)).verdict, Verdict::sound);
}

TEST(Verdict, NamesBoundsAndWhatIsNotDetermined) {
  FitEvidence evidence = evidence_of(1, 100, true);
  evidence.estimates[0] = {.name = "c", .value = 5.0, .lower_bound = 1.0, .upper_bound = 5.0, .at_bound = true};
  evidence.estimates[1].standard_error = std::numeric_limits<double>::infinity();
  EXPECT_THAT(judge(evidence).reasons,
              ElementsAre("c is at its upper bound, 5", HasSubstr("the data do not determine b")));
}

TEST(Verdict, ComparesStarts) {
  FitEvidence evidence = evidence_of(1, 100, true);
  evidence.estimates[0] = {.name = "c", .value = 3.0, .standard_error = 0.1};
  evidence.estimates[1] = {.name = "k", .value = 1.0, .standard_error = 0.1};
  evidence.starts = {{.rms = 1.0, .parameters = {3.0, 1.0}}, {.rms = 1.3, .parameters = {7.7, 1.0}}};
  EXPECT_EQ(judge(evidence).verdict, Verdict::sound);  // a poor minimum is no rival
  evidence.starts[1].rms = 1.001;
  ASSERT_EQ(judge(evidence).verdict, Verdict::questionable);
  EXPECT_THAT(judge(evidence).reasons[0], HasSubstr("c at 3 and 7.7"));
  evidence.starts[1].parameters[0] = 3.05;
  EXPECT_EQ(judge(evidence).verdict, Verdict::sound);
}

// The rms of starts is over all data: of 3 + 5000 of known noise a rise of the rms by 1e-3 is one of the sum by 10.
TEST(Verdict, CountsDataThatAreJudgedElsewhere) {
  FitEvidence evidence = evidence_of(1, 1, true);
  EXPECT_THAT(judge(evidence).reasons, ElementsAre(HasSubstr("3 data for 2 parameters")));
  evidence.n_elsewhere = 5000;
  EXPECT_THAT(judge(evidence).reasons, IsEmpty());
  evidence.estimates[0] = {.name = "c", .value = 3.0, .standard_error = 0.1};
  evidence.estimates[1] = {.name = "k", .value = 1.0, .standard_error = 0.1};
  evidence.starts = {{.rms = 1.0, .parameters = {3.0, 1.0}}, {.rms = 1.001, .parameters = {7.7, 1.0}}};
  EXPECT_THAT(judge(evidence).reasons, IsEmpty());
}

TEST(Verdict, FailsWhereThereIsNoFit) {
  FitEvidence evidence = evidence_of(1, 100, true);
  evidence.misfit = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judge(evidence).verdict, Verdict::failed);
  evidence.misfit = 0.98;
  EXPECT_THAT(judge(evidence).reasons, ElementsAre("the misfit is 0.98 times what was measured"));
  EXPECT_EQ(judge(evidence).verdict, Verdict::failed);
  evidence.misfit = 4.96;
  EXPECT_THAT(judge(evidence).reasons, ElementsAre("the misfit is 4.96 times what was measured"));
  evidence.misfit = 0.1;
  evidence.converged = false;
  evidence.message = "100 iterations";
  EXPECT_EQ(judge(evidence).verdict, Verdict::failed);
  EXPECT_THAT(judge(evidence).reasons, ElementsAre("the fit did not come to an end: 100 iterations"));
  evidence.converged = true;
  evidence.found = {"the sample is not passive"};
  EXPECT_EQ(judge(evidence).verdict, Verdict::questionable);
}

}  // namespace
}  // namespace pfdm::this_file
