// Fits of a misfit with many minima, a sin(b x) sampled over many periods: screened points, shared differences.

#include "physics/error.h"
#include "solver/calibration/calibration.h"
#include "solver/calibration/quasi_random.h"
#include "solver/parallel.h"
#include "tests/solver/simple_fits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace pfdm::this_file {
namespace {

/// The points at which a model was asked.
using Asked = std::set<std::vector<double>>;

/// Data of a = 2, b = 22 with noise 0.05, which is known; minima in b are about 6 apart.
FitProblem wave_problem(unsigned seed, Asked* asked = nullptr, int* evaluations = nullptr) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const std::vector<double> x = abscissas(60);
  std::vector<double> data;
  data.reserve(x.size());
  for (const double xi : x) data.push_back(2.0 * std::sin(22.0 * xi) + 0.05 * normal(engine));
  return {.parameters = {{.name = "a", .unit = "1", .first = 1.9, .lower = 0.1, .upper = 10.0, .log_scale = true},
                         {.name = "b", .unit = "1", .first = 14.0, .lower = 5.0, .upper = 50.0, .log_scale = true}},
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            if (asked != nullptr) asked->insert({p.begin(), p.end()});
            if (evaluations != nullptr) ++*evaluations;
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i) r.push_back((p[0] * std::sin(p[1] * x[i]) - data[i]) / 0.05);
            return r;
          },
          .noise_is_known = true};
}

FitSettings screening_settings() {
  return {.least_step = 1e-3, .step = 0.02, .side_by_side = false, .starts = 2, .spread = 0.6, .screened = 30};
}

TEST(Calibration, ScreensASampleForTheLowestMinimum) {
  EXPECT_GT(std::abs(fit(wave_problem(1)).estimates[1].value - 22.0), 2.0);  // another minimum
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const FitResult result = fit(wave_problem(seed), screening_settings());
    EXPECT_NEAR(result.estimates[1].value, 22.0, 0.1);
    EXPECT_NEAR(result.estimates[0].value, 2.0, 0.05);
    EXPECT_LT(result.rms, 1.5);
    EXPECT_EQ(result.starts.size(), 2u);
    ASSERT_EQ(result.screened.size(), 30u);
    EXPECT_NEAR(result.screened[0].parameters[1], 14.0, 1e-12);
  }
}

TEST(Calibration, ScreeningCostsLessThanDescendingFromEveryPoint) {
  int screened = 0, descended = 0;
  fit(wave_problem(1, nullptr, &screened), screening_settings());
  FitSettings all = screening_settings();
  all.starts = all.screened;
  all.screened = 0;
  fit(wave_problem(1, nullptr, &descended), all);
  EXPECT_LT(2 * screened, descended);
}

TEST(Calibration, SamplesWithinTheBoundsAndSpread) {
  FitProblem problem = wave_problem(1);
  problem.parameters[1].lower = 12.0;
  const FitResult result = fit(problem, screening_settings());
  std::vector<double> b;
  for (const FitIteration& point : result.screened) b.push_back(point.parameters[1]);
  EXPECT_GE(std::ranges::min(b), 12.0);
  EXPECT_LT(std::ranges::min(b), 12.5);
  EXPECT_LE(std::ranges::max(b), 14.0 * std::exp(0.6));
  EXPECT_GT(std::ranges::max(b), 13.0 * std::exp(0.6));
}

TEST(Calibration, SampleKeepsWhatIsKnown) {
  FitProblem problem = wave_problem(1);
  problem.parameters[0].is_sampled = false;
  problem.parameters[0].start = 1.9 * std::exp(0.04049);
  FitSettings settings = screening_settings();
  settings.least_step = 0.01;
  const FitResult result = fit(problem, settings);
  for (const FitIteration& point : result.screened) EXPECT_NEAR(point.parameters[0], 1.9 * std::exp(0.04), 1e-12);
  EXPECT_NEAR(result.estimates[1].value, 22.0, 0.2);
  problem.parameters[0].start = 11.0;
  EXPECT_THROW(fit(problem, settings), InputError);
}

/// Share of the points of a fit at which a fit to other data has been.
double share_met_again(const FitSettings& settings) {
  Asked first, second, both;
  const FitResult one = fit(wave_problem(1, &first), settings), other = fit(wave_problem(2, &second), settings);
  EXPECT_NE(one.values(), other.values());
  std::ranges::set_intersection(first, second, std::inserter(both, both.end()));
  return static_cast<double>(both.size()) / static_cast<double>(second.size());
}

TEST(Calibration, SharedDifferencesMeetAgainInFitsToOtherData) {
  // Both fits take their differences at the same points; central ones share those of the sample at most.
  FitSettings settings = screening_settings();
  const double central = share_met_again(settings);
  settings.differences = Differences::shared;
  const double shared = share_met_again(on_grid(settings)), to_the_end = share_met_again(settings);
  std::printf("shared points: %.0f %%, with those of the intervals %.0f %%, by central differences %.0f %%\n",
              100.0 * shared, 100.0 * to_the_end, 100.0 * central);
  EXPECT_GT(shared, 0.8);
  EXPECT_LT(central, shared - 0.1);
  EXPECT_LT(central, to_the_end - 0.1);
}

TEST(Calibration, SharedDifferencesCostTwoMoreRunsAParameterAtTheEnd) {
  FitSettings settings = screening_settings();
  settings.differences = Differences::shared;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Asked on_the_grid, to_the_end;
    fit(wave_problem(seed, &on_the_grid), on_grid(settings));
    settings.cost_tolerance = 1e-3;
    fit(wave_problem(seed, &to_the_end), settings);
    EXPECT_LE(to_the_end.size(), on_the_grid.size() + 4);
  }
}

TEST(Calibration, SharedDifferencesLeadToTheSameEstimates) {
  const FitProblem problem = decay_problem(0.05, 3);
  const FitResult central = fit(problem), shared = fit(problem, {.differences = Differences::shared, .step = 0.02});
  for (std::size_t j = 0; j < 2; ++j) {
    const FitEstimate &a = central.estimates[j], &b = shared.estimates[j];
    EXPECT_NEAR(b.value, a.value, 0.02 * a.standard_error);
    EXPECT_NEAR(b.standard_error, a.standard_error, 0.02 * a.standard_error);
  }
}

/// p^10 x_i against data of p = `truth` with known noise: d/d ln p = 10 p^10 x_i. A grid of 0.05 in ln p.
FitProblem power_problem(double truth, double noise) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal(0.0, noise);
  const std::vector<double> x = abscissas(60);
  std::vector<double> data;
  for (const double xi : x) data.push_back(std::pow(truth, 10) * xi + normal(engine));
  return {.parameters = {{.name = "p", .unit = "1", .first = 1.0, .lower = 0.1, .upper = 10.0, .log_scale = true}},
          .residuals = [=](std::span<const double> p) -> std::optional<std::vector<double>> {
            std::vector<double> r;
            for (std::size_t i = 0; i < x.size(); ++i) r.push_back((std::pow(p[0], 10) * x[i] - data[i]) / noise);
            return r;
          },
          .noise_is_known = true};
}

// Half a step off the derivative is exp(-+0.25) times that of the estimate. Central differences have it times
// sinh(0.5) / 0.5 = 1.042.
TEST(Calibration, SharedDifferencesHaveTheIntervalsOfTheEstimates) {
  double squares = 0.0;
  for (const double xi : abscissas(60)) squares += xi * xi;
  for (const double away : {-0.024, -0.012, 0.0, 0.012, 0.024}) {
    const double noise = 0.01;
    const FitResult result = fit(power_problem(std::exp(0.1 + away), noise),
                                 {.least_step = 1e-3, .differences = Differences::shared, .step = 0.05});
    const FitEstimate& p = result.estimates[0];
    const double exact = noise / (10.0 * std::pow(p.value, 10) * std::sqrt(squares));  // of ln p
    std::printf("%+.3f of a grid point: standard error %.3f of the exact one\n", away,
                p.standard_error / p.value / exact);
    EXPECT_NEAR(p.standard_error / p.value / exact, 0.5 / std::sinh(0.5), 1e-3);
    EXPECT_NEAR(std::log(p.upper_95 / p.lower_95), 2.0 * 1.96 * exact, 0.05 * 2.0 * 1.96 * exact);
  }
}

TEST(Calibration, SharedDifferencesEndWhereCentralOnesDo) {
  FitSettings shared{.cost_tolerance = 2e-4, .least_step = 2e-3, .step = 0.05};
  const FitSettings central = shared;
  shared.differences = Differences::shared;
  double moved = 0.0, moved_on_grid = 0.0, widest = 1.0, narrowest = 1.0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const double a = std::exp(0.15 + 0.05 * (radical_inverse(seed + 1, 2) - 0.5)),
                 b = std::exp(-0.1 + 0.05 * (radical_inverse(seed + 1, 3) - 0.5));
    const FitProblem problem = softening_problem(a, b, seed);
    const FitResult one = fit(problem, central), other = fit(problem, shared), rough = fit(problem, on_grid(shared));
    for (std::size_t j = 0; j < 2; ++j) {
      const FitEstimate &c = one.estimates[j], &s = other.estimates[j];
      moved = std::max(moved, std::abs(s.value - c.value) / c.standard_error);
      moved_on_grid = std::max(moved_on_grid, std::abs(rough.estimates[j].value - c.value) / c.standard_error);
      const double ratio = (s.upper_95 - s.lower_95) / (c.upper_95 - c.lower_95);
      widest = std::max(widest, ratio), narrowest = std::min(narrowest, ratio);
    }
  }
  std::printf(
      "intervals of %.3f to %.3f times the width, estimates up to %.3f standard errors apart, on the grid %.3f\n",
      narrowest, widest, moved, moved_on_grid);
  EXPECT_GT(narrowest, 0.98);
  EXPECT_LT(widest, 1.02);
  EXPECT_LT(moved, 0.4);  // steps shorter than ten of them end both
  EXPECT_GT(moved_on_grid, 1.0);
}

TEST(Calibration, SharedDifferencesCoverTheTruthAmongManyMinima) {
  int covered = 0;
  constexpr int repetitions = 200;
  FitSettings settings = screening_settings();
  settings.differences = Differences::shared;
  for (unsigned i = 0; i < repetitions; ++i) {
    const FitResult result = fit(wave_problem(500 + i), settings);
    covered += result.estimates[0].lower_95 <= 2.0 && 2.0 <= result.estimates[0].upper_95 ? 1 : 0;
    covered += result.estimates[1].lower_95 <= 22.0 && 22.0 <= result.estimates[1].upper_95 ? 1 : 0;
  }
  const double share = covered / (2.0 * repetitions);
  std::printf("95 %% intervals cover %.1f %%\n", 100.0 * share);
  EXPECT_GE(share, 0.92);
  EXPECT_LE(share, 0.98);
}

TEST(Calibration, RefusesASampleOfWhichNoPointConverges) {
  FitProblem problem = wave_problem(1);
  problem.residuals = [](std::span<const double>) { return std::optional<std::vector<double>>(); };
  EXPECT_THROW(fit(problem, screening_settings()), ComputationError);
}

}  // namespace
}  // namespace pfdm::this_file
