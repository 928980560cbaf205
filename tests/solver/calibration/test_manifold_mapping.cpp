// Fits of a fine model by a coarse one: a softening curve whose coarse twin is stiffer, weaker and shifted.

#include "solver/calibration/manifold_mapping.h"

#include "physics/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Force at displacement x of a specimen of stiffness p0 whose strength p1 is lost over the length p2.
double force(double x, std::span<const double> p) {
  const double elastic = p[0] * x;
  return elastic / std::pow(1.0 + std::pow(elastic / p[1], 4.0), 0.25) * std::exp(-std::pow(x / p[2], 2));
}

/// As a coarse mesh has it.
double coarse_force(double x, std::span<const double> p) {
  const std::vector<double> off{1.06 * p[0], 0.93 * p[1], 1.08 * p[2]};
  return force(x, off) + 0.02 * x * x;
}

FitProblem problem_of(double (*model)(double, std::span<const double>), unsigned seed, double noise) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, noise);
  const std::vector<double> truth{2.0, 1.2, 2.5};
  std::vector<double> x, data;
  for (int i = 1; i <= 80; ++i) {
    x.push_back(0.03 * i);
    data.push_back(force(x.back(), truth) + normal(engine));
  }
  FitProblem problem;
  const std::vector<double> first{1.7, 1.4, 2.1};
  for (std::size_t j = 0; j < first.size(); ++j)
    problem.parameters.push_back({.name = std::string("p") + std::to_string(j),
                                  .unit = "1",
                                  .first = first[j],
                                  .lower = 0.2 * first[j],
                                  .upper = 5.0 * first[j],
                                  .log_scale = true});
  problem.residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
    std::vector<double> r;
    for (std::size_t i = 0; i < x.size(); ++i) r.push_back((model(x[i], p) - data[i]) / noise);
    return r;
  };
  problem.noise_is_known = true;
  return problem;
}

const FitSettings settings{.cost_tolerance = 0.02 / 80.0, .least_step = 1e-6, .trust_radius = 30.0, .step = 0.01};

TEST(ManifoldMapping, EndsAtTheMinimumOfTheFineModel) {
  int most = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const FitProblem fine = problem_of(force, seed, 0.02);
    const FitResult alone = fit(fine, settings);
    const MappedFit mapped = fit_by_mapping(fine, {problem_of(coarse_force, seed, 0.02)}, settings);
    ASSERT_THAT(mapped.failure, IsEmpty()) << seed;
    most = std::max(most, mapped.result.evaluations);
    for (std::size_t j = 0; j < 3; ++j) {
      const double error = alone.estimates[j].standard_error;
      EXPECT_NEAR(mapped.result.estimates[j].value, alone.estimates[j].value, 0.15 * error) << seed << " " << j;
      EXPECT_NEAR(mapped.result.estimates[j].standard_error, error, 0.1 * error) << seed << " " << j;
    }
    const auto here = fine.residuals(mapped.best);
    EXPECT_EQ(mapped.result.residuals, *here) << seed;
    EXPECT_EQ(mapped.mapped.residuals(mapped.best), here) << seed;
  }
  EXPECT_LE(most, 8);
}

TEST(ManifoldMapping, TellsOfACoarseModelThatDoesNotLead) {
  const auto line = [](double x, std::span<const double> p) { return p[0] - p[1] * x + 0.1 * p[2]; };
  const MappedFit mapped = fit_by_mapping(problem_of(force, 1, 0.02), {problem_of(line, 1, 0.02)}, settings);
  EXPECT_FALSE(mapped.failure.empty());
  EXPECT_EQ(mapped.best.size(), 3u);
}

TEST(ManifoldMapping, TellsWhereOneOfTheModelsDoesNotConverge) {
  const FitProblem fine = problem_of(force, 1, 0.02);
  FitProblem none = fine;
  none.residuals = [](std::span<const double>) { return std::nullopt; };
  const MappedFit mapped = fit_by_mapping(none, {problem_of(coarse_force, 1, 0.02)}, settings);
  EXPECT_THAT(mapped.failure, HasSubstr("does not converge where the coarse one fits best"));
  EXPECT_THAT(mapped.best, IsEmpty());
  EXPECT_THROW(fit_by_mapping(fine, {none}, settings), ComputationError);
}

TEST(ManifoldMapping, LetsTheCoarseModelMeetTheFineOne) {
  FitProblem coarse = problem_of(coarse_force, 3, 0.02);
  std::vector<std::vector<double>> met;
  const MappedFit mapped =
      fit_by_mapping(problem_of(force, 3, 0.02),
                     {coarse, [&](std::span<const double> p) { met.emplace_back(p.begin(), p.end()); }}, settings);
  ASSERT_THAT(mapped.failure, IsEmpty());
  ASSERT_GE(met.size(), 2u);
  EXPECT_EQ(met.back(), mapped.best);
}

}  // namespace
}  // namespace pfdm::this_file
