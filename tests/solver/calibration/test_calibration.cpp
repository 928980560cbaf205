#include "physics/error.h"
#include "solver/calibration/calibration.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/parallel.h"
#include "tests/solver/simple_fits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(Calibration, FindsTheParametersOfDataWithoutNoise) {
  for (const bool log_scale : {false, true})
    for (const Differences way : {Differences::central, Differences::forward}) {
      FitProblem problem = decay_problem(0.0, 1);
      for (FitParameter& p : problem.parameters) p.log_scale = log_scale;
      const FitResult result = fit(problem, {.differences = way});
      EXPECT_TRUE(result.converged) << result.message;
      EXPECT_NEAR(result.estimates[0].value, 3.0, 1e-8);
      EXPECT_NEAR(result.estimates[1].value, 2.0, 1e-8);
      EXPECT_LE(result.rms, 1e-9);
      ASSERT_GE(result.path.size(), 3u);
      EXPECT_GT(result.path.front().rms, 100.0 * result.path.back().rms);
      EXPECT_EQ(result.path.front().parameters, (std::vector<double>{1.0, 5.0}));
      for (std::size_t i = 1; i < result.path.size(); ++i) EXPECT_LE(result.path[i].rms, result.path[i - 1].rms);
    }
}

TEST(Calibration, CovarianceOfALine) {
  // By hand: x = 0, 1, 2, 3, y = 0.1, 0.9, 2.2, 2.8: p = (0.09, 0.94), sum of squares 0.082, s^2 = 0.041,
  // var p1 = s^2 / 5, var p0 = s^2 * 14 / 20, cov = -s^2 * 6 / 20; t(2) = 4.302653.
  const FitResult result = fit(line_problem({0, 1, 2, 3}, {0.1, 0.9, 2.2, 2.8}));
  EXPECT_NEAR(result.estimates[0].value, 0.09, 1e-10);
  EXPECT_NEAR(result.estimates[1].value, 0.94, 1e-10);
  EXPECT_NEAR(result.sum_of_squares, 0.082, 1e-10);
  EXPECT_NEAR(result.covariance(0, 0), 0.041 * 0.7, 1e-9);
  EXPECT_NEAR(result.covariance(1, 1), 0.041 / 5.0, 1e-9);
  EXPECT_NEAR(result.covariance(0, 1), -0.041 * 0.3, 1e-9);
  EXPECT_NEAR(result.correlation(0, 1), -0.3 / std::sqrt(0.7 * 0.2), 1e-7);
  EXPECT_NEAR(result.estimates[1].upper_95 - 0.94, 4.302653 * std::sqrt(0.041 / 5.0), 1e-6);
  EXPECT_NEAR(result.estimates[1].standard_error, std::sqrt(0.041 / 5.0), 1e-9);
}

TEST(Calibration, StudentsT) {
  EXPECT_NEAR(student_95(5), 2.5705818366, 1e-9);  // tables
  EXPECT_NEAR(student_95(1e9), 1.9599639845, 1e-6);
  EXPECT_TRUE(std::isinf(student_95(0)));
}

TEST(Calibration, IntervalsCoverTheTruth) {
  int covered = 0;
  constexpr int repetitions = 400;
  for (unsigned i = 0; i < repetitions; ++i) {
    FitProblem problem = decay_problem(0.1, 100 + i, 12);
    problem.parameters[1].log_scale = true;
    const FitResult result = fit(problem);
    for (std::size_t j = 0; j < 2; ++j) {
      const double truth = j == 0 ? 3.0 : 2.0;
      covered += result.estimates[j].lower_95 <= truth && truth <= result.estimates[j].upper_95 ? 1 : 0;
    }
  }
  const double share = covered / (2.0 * repetitions);
  std::printf("95 %% intervals cover %.1f %%\n", 100.0 * share);
  EXPECT_GE(share, 0.92);
  EXPECT_LE(share, 0.98);
}

TEST(Calibration, TakesAJacobian) {
  FitProblem problem = decay_problem(0.05, 3);
  const FitResult by_differences = fit(problem);
  int calls = 0;
  problem.parameters[1].log_scale = true;
  problem.jacobian = [&](std::span<const double> p) -> std::optional<Eigen::MatrixXd> {
    ++calls;
    const std::vector<double> x = abscissas(50);
    Eigen::MatrixXd J(50, 2);
    for (int i = 0; i < 50; ++i) {
      const double xi = x[i];
      J.row(i) << std::exp(-p[1] * xi), -xi * p[0] * std::exp(-p[1] * xi);
    }
    return J;
  };
  const FitResult result = fit(problem);
  EXPECT_GT(calls, 2);
  EXPECT_NEAR(result.estimates[1].value, by_differences.estimates[1].value, 1e-7);
  EXPECT_NEAR(result.estimates[1].standard_error, by_differences.estimates[1].standard_error, 1e-6);
}

TEST(Calibration, NamesWhatTheDataCannotTell) {
  FitProblem problem = line_problem({0, 1, 2, 3}, {0.1, 0.9, 2.2, 2.8});
  const Residuals line = problem.residuals;
  problem.parameters.push_back({.name = "ghost", .unit = "m", .first = 7.0});
  FitResult result = fit(problem);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("the data do not determine ghost")));
  EXPECT_TRUE(std::isinf(result.estimates[2].standard_error));
  EXPECT_NEAR(result.estimates[1].value, 0.94, 1e-9);

  problem.parameters[2].name = "twin";
  problem.residuals = [&](std::span<const double> p) { return line(std::vector<double>{p[0], p[1] * p[2]}); };
  result = fit(problem);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("determine only a combination of p1, twin")));
  EXPECT_NEAR(result.estimates[1].value * result.estimates[2].value, 0.94, 1e-8);
  EXPECT_TRUE(std::isinf(result.estimates[1].standard_error));
  EXPECT_TRUE(std::isfinite(result.estimates[0].standard_error));
}

TEST(Calibration, KeepsToTheBounds) {
  FitProblem problem = line_problem({0, 1, 2, 3}, {0.1, 0.9, 2.2, 2.8});
  problem.parameters[1].upper = 0.8;
  problem.parameters[1].first = 0.5;
  const FitResult result = fit(problem);
  EXPECT_NEAR(result.estimates[1].value, 0.8, 1e-9);
  EXPECT_TRUE(result.estimates[1].at_bound);
  EXPECT_FALSE(result.estimates[0].at_bound);
  EXPECT_NEAR(result.estimates[0].value, 1.5 - 0.8 * 1.5, 1e-8);  // mean of y less slope times mean of x
  EXPECT_THAT(result.warnings, Contains(HasSubstr("p1 is at its bound")));
}

TEST(Calibration, SurvivesAModelThatDoesNotConvergeEverywhere) {
  FitProblem problem = decay_problem(0.0, 1);
  const Residuals model = problem.residuals;
  int refused = 0;
  problem.residuals = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
    if (p[1] > 1.5 && p[1] < 4.9) return model(p);
    ++refused;
    return std::nullopt;
  };
  problem.parameters[0].first = 3.5;
  problem.parameters[1].first = 4.8999999;  // the difference to one side cannot be evaluated
  const FitResult result = fit(problem, {.side_by_side = false});
  EXPECT_GT(refused, 0);
  EXPECT_NEAR(result.estimates[1].value, 2.0, 1e-6);
  problem.residuals = [](std::span<const double>) { return std::optional<std::vector<double>>(); };
  EXPECT_THROW(fit(problem), ComputationError);
}

TEST(Calibration, WeighsPriorsAgainstTheData) {
  // One datum p0 = 2 +- 1 and a prior of 4 +- 1: the mean 3, variance 1/2.
  FitProblem problem{
      .parameters = {{.name = "p", .unit = "1", .first = 1.0, .prior = GaussianPrior{4.0, 1.0}}},
      .residuals = [](std::span<const double> p) { return std::optional(std::vector<double>{p[0] - 2.0}); },
      .noise_is_known = true};
  const FitResult result = fit(problem);
  EXPECT_NEAR(result.estimates[0].value, 3.0, 1e-7);
  EXPECT_NEAR(result.covariance(0, 0), 0.5, 1e-8);
  EXPECT_EQ(result.residuals.size(), 1u);
  // On a logarithmic scale: ln p = 1 +- 0.1 twice.
  problem.parameters[0] = {
      .name = "p", .unit = "1", .first = 1.0, .log_scale = true, .prior = GaussianPrior{std::exp(1.2), 0.1}};
  problem.residuals = [](std::span<const double> p) {
    return std::optional(std::vector<double>{(std::log(p[0]) - 1.0) / 0.1});
  };
  EXPECT_NEAR(std::log(fit(problem).estimates[0].value), 1.1, 1e-7);
}

TEST(Calibration, StartsElsewhereToo) {
  // Two wells, the deeper one far from the first guess.
  FitProblem problem{.parameters = {{.name = "p", .unit = "1", .first = -1.0, .lower = -2.0, .upper = 3.0}},
                     .residuals = [](std::span<const double> p) {
                       return std::optional(std::vector<double>{p[0] * p[0] - 1.0, 0.2 * (p[0] - 1.0)});
                     }};
  EXPECT_NEAR(fit(problem).estimates[0].value, -0.98, 0.02);
  const FitResult result = fit(problem, {.starts = 8, .spread = 4.0});
  EXPECT_NEAR(result.estimates[0].value, 1.0, 1e-6);
  EXPECT_EQ(result.starts.size(), 8u);
}

TEST(Calibration, DoesNotDependOnTheNumberOfThreads) {
  const FitResult one = fit(decay_problem(0.1, 5));
  set_threads(3);
  const FitResult three = fit(decay_problem(0.1, 5));
  set_threads(1);
  EXPECT_EQ(one.values(), three.values());
  EXPECT_EQ(one.covariance, three.covariance);
}

TEST(Calibration, RobustLossLeavesOutliersOut) {
  std::vector<double> x = abscissas(21), y;
  for (const double xi : x) y.push_back(1.0 + 2.0 * xi);
  y[4] += 50.0;
  EXPECT_GT(std::abs(fit(line_problem(x, y)).estimates[0].value - 1.0), 1.0);
  EXPECT_NEAR(fit(line_problem(x, y), {.robust_scale = 1.0}).estimates[0].value, 1.0, 0.3);
}

TEST(Calibration, RefusesProblemsThatMakeNoSense) {
  const auto refused = [](auto change) -> std::string {
    FitProblem problem = line_problem({0, 1, 2, 3}, {0.1, 0.9, 2.2, 2.8});
    change(problem);
    try {
      fit(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(refused([](FitProblem& p) { p.parameters[0].lower = 2.0; }),
              HasSubstr("p0: the first guess 1 is not within"));
  EXPECT_THAT(refused([](FitProblem& p) { p.parameters[1].prior = GaussianPrior{1.0, 1.0}; }), HasSubstr("noise"));
  EXPECT_THAT(refused([](FitProblem& p) {
                p.parameters[1].first = -1.0;
                p.parameters[1].log_scale = true;
              }),
              HasSubstr("must be positive"));
  EXPECT_THAT(refused([](FitProblem& p) { p.parameters.clear(); }), HasSubstr("no parameter"));
  EXPECT_THAT(refused([](FitProblem& p) {
                p.residuals = [](std::span<const double> q) { return std::optional(std::vector<double>{q[0] + q[1]}); };
              }),
              HasSubstr("1 residuals cannot determine 2 parameters"));
}

TEST(Calibration, EndsWhereNoParameterMatters) {
  FitProblem problem;
  problem.parameters = {{.name = "idle", .unit = "1", .first = 2.0}};
  problem.residuals = [](std::span<const double>) { return std::optional(std::vector<double>{1.0, -1.0, 0.5}); };
  const FitResult result = fit(problem);
  EXPECT_EQ(result.estimates[0].value, 2.0);
  EXPECT_TRUE(std::isinf(result.estimates[0].standard_error));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("do not determine idle"), std::string::npos);
}

// Data with noise about a step of height 4 at 5.3, which a model that jumps between the points cannot be moved by.
TEST(Calibration, DifferencesOfAveragedResidualsFindWhereAModelJumps) {
  std::mt19937 engine(4);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<double> data;
  for (int i = 0; i < 12; ++i) data.push_back((i < 5.3 ? 4.0 : 0.0) + noise(engine));
  FitProblem problem{.parameters = {{.name = "p", .unit = "1", .first = 4.45, .lower = 1.0, .upper = 10.0}},
                     .residuals = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
                       std::vector<double> r;
                       for (int i = 0; i < 12; ++i) r.push_back((i < p[0] ? 4.0 : 0.0) - data[std::size_t(i)]);
                       return r;
                     },
                     .noise_is_known = true};
  const FitSettings settings{.step = 0.02};
  EXPECT_THAT(fit(problem, settings).warnings, Contains(HasSubstr("no influence on the residuals")));
  problem.averaged = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
    std::vector<double> r;
    for (int i = 0; i < 12; ++i) r.push_back(2.0 * std::clamp(p[0] - i + 1.0, 0.0, 2.0) - data[std::size_t(i)]);
    return r;
  };
  const FitResult found = fit(problem, settings);
  EXPECT_GT(found.estimates[0].value, 5.0);
  EXPECT_LT(found.estimates[0].value, 6.0);
  EXPECT_NEAR(found.estimates[0].standard_error, std::sqrt(0.5) / 2.0, 1e-3);  // 2 of two points
}

}  // namespace
}  // namespace pfdm::this_file
