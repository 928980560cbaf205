// The end of fits with shared differences: on from the grid, by differences about the estimates.

#include "solver/calibration/calibration.h"
#include "solver/calibration/profile_likelihood.h"
#include "solver/calibration/quasi_random.h"
#include "tests/solver/simple_fits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace pfdm::this_file {
namespace {

using testing::Contains;
using testing::HasSubstr;

FitSettings shared_settings() {
  FitSettings settings{.cost_tolerance = 2e-4, .least_step = 2e-3, .step = 0.05};
  settings.differences = Differences::shared;
  return settings;
}

/// Anywhere between the points of the grid.
FitProblem softening_beside_the_grid(unsigned seed, double noise = 0.0004) {
  return softening_problem(std::exp(0.15 + 0.05 * (radical_inverse(seed + 1, 2) - 0.5)),
                           std::exp(-0.1 + 0.05 * (radical_inverse(seed + 1, 3) - 0.5)), seed, noise);
}

TEST(Calibration, SharedDifferencesEndOnTheGridWhereTheModelFailsBesideTheEstimates) {
  FitProblem problem = softening_beside_the_grid(1);
  const FitResult rough = fit(problem, on_grid(shared_settings()));
  const double a = rough.estimates[0].value, b = rough.estimates[1].value;
  problem.residuals = [=, all = problem.residuals](std::span<const double> p) -> std::optional<std::vector<double>> {
    const double away = std::abs(std::log(p[1] / b));
    if (std::abs(away - 0.05) < 1e-3 && std::abs(std::log(p[0] / a)) < 1e-4) return std::nullopt;
    return all(p);
  };
  const FitResult result = fit(problem, shared_settings());
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(result.estimates[j].value, rough.estimates[j].value);
    EXPECT_DOUBLE_EQ(result.estimates[j].standard_error, rough.estimates[j].standard_error);
  }
  EXPECT_THAT(result.warnings, Contains(HasSubstr("about the nearest point of the grid")));
}

TEST(Calibration, SharedDifferencesHaveTheEndAmongTheStarts) {
  FitSettings settings = shared_settings();
  settings.starts = 2;
  settings.spread = 0.1;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const FitResult result = fit(softening_beside_the_grid(seed, 1e-4), settings);
    const FitIteration& best = *std::ranges::min_element(result.starts, {}, &FitIteration::rms);
    EXPECT_DOUBLE_EQ(best.rms, result.path.back().rms) << seed;
    EXPECT_EQ(best.parameters, result.path.back().parameters) << seed;
  }
}

TEST(Calibration, SharedDifferencesTellEveryPointOnce) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    FitSettings settings = shared_settings();
    std::vector<std::vector<double>> told, path;
    settings.iterated = [&](const FitIteration& iteration) { told.push_back(iteration.parameters); };
    for (const FitIteration& i : fit(softening_beside_the_grid(seed, 1e-4), settings).path)
      path.push_back(i.parameters);
    EXPECT_EQ(std::ranges::adjacent_find(path), path.end()) << seed;
    EXPECT_EQ(path, told) << seed;
  }
}

}  // namespace
}  // namespace pfdm::this_file
