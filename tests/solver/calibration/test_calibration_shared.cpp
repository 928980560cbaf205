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

/// Points at which profiles of all three parameters ask the model, beside those of the fit, and their ends.
struct Profiled {
  std::size_t n_asked = 0;
  std::vector<double> ends;
  std::vector<double> errors;  // standard ones, of the logarithms
};

Profiled profiled(double noise, unsigned seed, const FitSettings& of_fit, const FitSettings& of_profiles) {
  const FitProblem two = softening_beside_the_grid(seed, noise);
  std::set<std::vector<double>> asked;
  FitProblem problem = two;
  problem.parameters.push_back(two.parameters[1]);
  problem.parameters.back().name = "c";
  problem.residuals = [&](std::span<const double> p) {
    asked.insert({p.begin(), p.end()});
    auto r = two.residuals(p.first(2));
    for (std::size_t i = 0; i < r->size(); ++i)
      (*r)[i] += std::log(p[2]) * std::sin(0.2 * static_cast<double>(i)) / 0.02;
    return r;
  };
  const FitResult result = fit(problem, of_fit);
  const std::size_t n_of_fit = asked.size();
  Profiled found;
  for (std::size_t k = 0; k < 3; ++k) {
    const ProfileInterval interval = profile_interval(problem, of_profiles, result, k);
    found.ends.push_back(std::log(interval.lower_95));
    found.ends.push_back(std::log(interval.upper_95));
    found.errors.push_back(result.estimates[k].standard_error / result.estimates[k].value);
  }
  found.n_asked = asked.size() - n_of_fit;
  return found;
}

TEST(Calibration, SharedDifferencesLeadProfilesToTheEndsOfCentralOnes) {
  FitSettings shared = shared_settings(), central = shared;
  shared.side_by_side = central.side_by_side = false;
  central.differences = Differences::central;
  for (const double noise : {1e-2, 4e-4}) {
    double most = 0.0, most_on_grid = 0.0;
    std::size_t n_shared = 0, n_central = 0, n_grid = 0;
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Profiled one = profiled(noise, seed, central, central), other = profiled(noise, seed, shared, shared);
      n_shared += other.n_asked, n_central += one.n_asked;
      const Profiled rough = profiled(noise, seed, shared, on_grid(shared));
      n_grid += rough.n_asked;
      for (std::size_t i = 0; i < 6; ++i) {
        most = std::max(most, std::abs(other.ends[i] - one.ends[i]) / one.errors[i / 2]);
        most_on_grid = std::max(most_on_grid, std::abs(rough.ends[i] - one.ends[i]) / one.errors[i / 2]);
      }
    }
    std::printf(
        "noise %g: %zu runs by shared differences, %zu on their grid, %zu by central ones; ends %.3f apart, %.3f\n",
        noise, n_shared, n_grid, n_central, most, most_on_grid);
    EXPECT_LT(most, 0.03) << noise;
    EXPECT_LE(n_shared, n_grid + 60 * 5) << noise;  // at each end four runs of differences, and one more step
  }
}

}  // namespace
}  // namespace pfdm::this_file
