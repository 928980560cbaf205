#include "solver/calibration/profile_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/error.h"
#include "solver/calibration/calibration_statistics.h"

namespace pfdm::this_file {
namespace {

const std::vector<double> bod_time{1, 2, 3, 4, 5, 7}, bod_demand{8.3, 10.3, 19.0, 16.0, 15.6, 19.8};
const std::vector<double> rate_at{0.02, 0.02, 0.06, 0.06, 0.11, 0.11, 0.22, 0.22, 0.56, 0.56, 1.1, 1.1},
    rate{76, 47, 97, 107, 123, 139, 159, 152, 191, 201, 207, 200};

using Model = double (*)(double x, std::span<const double> p);
double saturating(double x, std::span<const double> p) { return p[0] * (1.0 - std::exp(-p[1] * x)); }
double michaelis(double x, std::span<const double> p) { return p[0] * x / (p[1] + x); }
double decaying(double x, std::span<const double> p) { return p[0] + p[1] * std::exp(-p[2] * x); }

FitProblem problem_of(Model model, const std::vector<double>& x, const std::vector<double>& y,
                      std::vector<FitParameter> parameters, double sigma = 0.0) {
  return {.parameters = std::move(parameters),
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i)
              r.push_back((model(x[i], p) - y[i]) / (sigma > 0.0 ? sigma : 1.0));
            return r;
          },
          .noise_is_known = sigma > 0.0};
}

FitParameter parameter(std::string name, double first, double lower, double upper, bool log_scale) {
  return {.name = std::move(name), .unit = "1", .first = first, .lower = lower, .upper = upper, .log_scale = log_scale};
}

void expect_interval(const FitProblem& problem, std::size_t k, double lower, double upper, double share = 2e-3,
                     double precision = 1e-4) {
  const FitSettings settings;
  const FitResult result = fit(problem, settings);
  const ProfileInterval found =
      profile_interval(problem, settings, result, k, {.precision = precision, .most_points = 30});
  EXPECT_NEAR(found.lower_95, lower, share * (upper - lower)) << k;
  EXPECT_NEAR(found.upper_95, upper, share * (upper - lower)) << k;
  EXPECT_FALSE(found.lower_open || found.upper_open);
  EXPECT_FALSE(found.better);
  EXPECT_GT(found.evaluations, 0);
}

// Biochemical oxygen demand and the rate of an enzyme (Bates, Watts 1988, appendix 1): ends by SciPy, brentq over
// least_squares of the other parameter.
TEST(ProfileIntervals, AreThoseOfSciPy) {
  for (const bool log_scale : {false, true}) {
    const FitProblem demand =
        problem_of(saturating, bod_time, bod_demand,
                   {parameter("a", 15.0, 1.0, 1e3, log_scale), parameter("b", 1.0, 1e-4, 1e2, log_scale)});
    expect_interval(demand, 0, 14.049364, 38.456198);
    expect_interval(demand, 1, 0.13139775, 1.8081696);
    const FitProblem with_noise =
        problem_of(saturating, bod_time, bod_demand,
                   {parameter("a", 15.0, 1.0, 1e3, log_scale), parameter("b", 1.0, 1e-4, 1e2, log_scale)}, 2.0);
    expect_interval(with_noise, 0, 16.008209, 24.844706);
    expect_interval(with_noise, 1, 0.27863236, 0.96962324);
    const FitProblem enzyme =
        problem_of(michaelis, rate_at, rate,
                   {parameter("V", 150.0, 1.0, 1e4, log_scale), parameter("K", 0.1, 1e-4, 1e2, log_scale)});
    expect_interval(enzyme, 0, 197.301933, 229.289055);
    expect_interval(enzyme, 1, 0.046920342, 0.086156914);
    expect_interval(enzyme, 0, 197.301933, 229.289055, 0.01, ProfileSettings{}.precision);
  }
}

TEST(ProfileIntervals, OfThreeParametersAreThoseOfSciPy) {
  std::vector<double> x, y;
  for (int i = 0; i < 16; ++i) {
    x.push_back(0.2 * i);
    y.push_back(2.0 + 3.0 * std::exp(-1.3 * x.back()) + 0.1 * std::sin(7.0 * i + 0.5));
  }
  const FitProblem problem = problem_of(decaying, x, y,
                                        {parameter("c", 1.0, -10.0, 10.0, false), parameter("a", 1.0, 0.1, 100.0, true),
                                         parameter("b", 1.0, 0.1, 10.0, true)});
  expect_interval(problem, 0, 1.8857569, 2.0760886);
  expect_interval(problem, 1, 2.9626329, 3.2407434);
  expect_interval(problem, 2, 1.1697241, 1.4787595);
}

// Of a linear model they are the linear ones.
TEST(ProfileIntervals, OfALinearModelAreTheLinearOnes) {
  const auto line = [](double x, std::span<const double> p) { return p[0] + p[1] * x; };
  const FitProblem problem = problem_of(
      line, bod_time, bod_demand, {parameter("p0", 1.0, -1e3, 1e3, false), parameter("p1", 1.0, -1e3, 1e3, false)});
  const FitResult result = fit(problem);
  for (std::size_t k = 0; k < 2; ++k)
    expect_interval(problem, k, result.estimates[k].lower_95, result.estimates[k].upper_95, 1e-4);
}

TEST(ProfileIntervals, OfOneParameterNeedNoFit) {
  const auto growth = [](double x, std::span<const double> p) { return std::exp(p[0] * x); };
  const FitProblem problem =
      problem_of(growth, {0.0, 1.0, 2.0}, {1.1, 2.7, 7.3}, {parameter("p", 1.0, 0.0, 5.0, false)}, 0.3);
  const FitResult result = fit(problem);
  const ProfileInterval found = profile_interval(problem, {}, result, 0);
  for (const double end : {found.lower_95, found.upper_95}) {
    double sum = 0.0;
    const auto residuals = problem.residuals(std::span(&end, 1));
    for (const double r : *residuals) sum += r * r;
    EXPECT_NEAR(std::sqrt(sum - result.sum_of_squares), 1.959964, 0.01);
  }
  EXPECT_LT(found.lower_95, found.upper_95);
}

// The amplitude of a decay that is over before the second point: with any rate above some the data are the same.
TEST(ProfileIntervals, EndAtABoundWhereTheDataAllowEverythingUpToIt) {
  const FitProblem problem = problem_of(decaying, {0.0, 1.0, 2.0, 3.0, 4.0}, {5.0, 2.1, 1.9, 2.05, 1.95},
                                        {parameter("c", 1.0, -10.0, 10.0, false), parameter("a", 1.0, 0.1, 100.0, true),
                                         parameter("b", 3.0, 0.1, 50.0, true)});
  const FitResult result = fit(problem);
  const ProfileInterval found = profile_interval(problem, {}, result, 2);
  EXPECT_TRUE(found.upper_open);
  EXPECT_DOUBLE_EQ(found.upper_95, 50.0);
  EXPECT_FALSE(found.lower_open);
  EXPECT_GT(found.lower_95, 0.5);
  EXPECT_LT(found.lower_95, result.estimates[2].value);
}

// A fit that ended in the higher of two minima.
TEST(ProfileIntervals, NameABetterPoint) {
  const auto valley = [](double, std::span<const double> p) { return p[0] * p[0] * p[0] - 3.0 * p[0] - 0.1 * p[1]; };
  FitProblem problem = problem_of(valley, {0.0, 1.0, 2.0}, {3.0, 3.0, 3.0},
                                  {parameter("x", -1.2, -4.0, 2.1, false), parameter("y", 0.0, -1.0, 1.0, false)}, 5.0);
  problem.parameters[0].upper = 0.0;
  const FitResult result = fit(problem);
  ASSERT_LT(result.estimates[0].value, -0.5);
  problem.parameters[0].upper = 2.1;
  const ProfileInterval found = profile_interval(problem, {}, result, 0);
  ASSERT_TRUE(found.better);
  EXPECT_GT(found.better->value, 1.0);
}

TEST(ProfileIntervals, SayWhereTheModelDoesNotConverge) {
  FitProblem problem = problem_of(saturating, bod_time, bod_demand,
                                  {parameter("a", 15.0, 1.0, 1e3, true), parameter("b", 1.0, 1e-4, 1e2, true)});
  const FitResult result = fit(problem);
  problem.residuals = [](std::span<const double>) { return std::nullopt; };
  EXPECT_THROW(profile_interval(problem, {}, result, 0), ComputationError);
}

}  // namespace
}  // namespace pfdm::this_file
