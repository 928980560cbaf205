// Fits of a misfit with many minima, a sin(b x) sampled over many periods: screened points, shared differences.

#include "physics/error.h"
#include "solver/calibration/calibration.h"
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

TEST(Calibration, SharedDifferencesMeetAgainInFitsToOtherData) {
  // Both fits take their differences at the same points; central ones share those of the sample at most.
  const auto share = [](Differences differences) {
    FitSettings settings = screening_settings();
    settings.differences = differences;
    Asked first, second, both;
    const FitResult one = fit(wave_problem(1, &first), settings), other = fit(wave_problem(2, &second), settings);
    EXPECT_NE(one.values(), other.values());
    std::ranges::set_intersection(first, second, std::inserter(both, both.end()));
    return static_cast<double>(both.size()) / static_cast<double>(second.size());
  };
  const double shared = share(Differences::shared), central = share(Differences::central);
  std::printf("shared points: %.0f %%, by central differences %.0f %%\n", 100.0 * shared, 100.0 * central);
  EXPECT_GT(shared, 0.8);
  EXPECT_LT(central, shared - 0.1);
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
