// Rows that a testing machine dropped, by repetition. SYNTHETIC data.

#include "postproc/fits/stray_row.h"
#include "tests/solver/noisy_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

constexpr std::size_t n = 100, dropped = 20;

/// What noisy_bar::problem() takes for measured, of the largest force.
std::vector<double> record(const std::vector<double>& noise) {
  using namespace noisy_bar;
  std::vector<double> values;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const double u = range * static_cast<double>(i) / static_cast<double>(noise.size() - 1);
    values.push_back(force(u, truth[0], truth[1], truth[2]) / (area * truth[1]) + 0.02 * noise[i]);
  }
  return values;
}

FitResult fitted(const std::vector<double>& noise) { return fit(noisy_bar::problem(noise), {.step = 1e-4}); }

TEST(StrayRow, OfADroppedRowIsFoundAndItsShiftIsThatOfLeavingItOut) {
  std::mt19937_64 engine(3);
  std::vector<double> noise = noisy_bar::noise("white", n, engine);
  const FitResult sound = fitted(noise);
  noise[dropped] -= record(noise)[dropped] / 0.02;
  ASSERT_NEAR(record(noise)[dropped], 0.0, 1e-12);
  const FitResult result = fitted(noise);
  const auto stray = stray_row(result, {record(noise)});
  ASSERT_TRUE(stray);
  EXPECT_EQ(stray->row, dropped);
  EXPECT_GT(stray->distance, 20.0);
  EXPECT_LT(stray->probability, 1e-12);
  double moved = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const FitEstimate &with = result.estimates[j], &without = sound.estimates[j];
    moved = std::max(moved, std::abs(std::log(with.value / without.value)) * without.value / without.standard_error);
  }
  EXPECT_GT(moved, 1.0);
  EXPECT_NEAR(stray->shift / moved, 1.0, 0.3);  // the fit is not linear
}

TEST(StrayRow, IsNoneOfNoise) {
  for (const char* kind : {"white", "ar 0.6", "slow", "steps", "mesh"}) {
    std::mt19937_64 engine(4);
    int told = 0;
    for (int k = 0; k < 200; ++k) {
      const std::vector<double> noise = noisy_bar::noise(kind, n, engine);
      const auto stray = stray_row(fitted(noise), {record(noise)});
      told += stray && stray->probability < 1e-3 ? 1 : 0;
    }
    EXPECT_LE(told, 2) << kind << ", of 200";
  }
}

// A row that determines a parameter alone lies on the fit whatever was measured there.
TEST(StrayRow, ThatDeterminesAParameterAloneIsNone) {
  std::mt19937_64 engine(6);
  const std::vector<double> noise = noisy_bar::noise("white", n, engine);
  FitResult result = fitted(noise);
  std::vector<double> values = record(noise);
  values[dropped] += 10.0;
  result.residuals[dropped] = -10.0;
  result.derivatives.row(dropped).setZero();
  result.derivatives(dropped, 2) = std::sqrt(1.0 / result.inverse_normal(2, 2));
  const auto stray = stray_row(result, {values});
  EXPECT_TRUE(!stray || stray->row != dropped);
}

// A specimen that breaks a row later than the model is far off it there, but not off the row before.
TEST(StrayRow, BesideAJumpIsNone) {
  constexpr std::size_t last = 60;
  std::mt19937_64 engine(5);
  const std::vector<double> noise = noisy_bar::noise("white", n, engine);
  const auto line = [](double slope, std::size_t until) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(slope * static_cast<double>(i) * (i <= until ? 1.0 : 0.3));
    return values;
  };
  std::vector<double> measured = line(0.01, last);
  for (std::size_t i = 0; i < n; ++i) measured[i] += 0.01 * noise[i];
  FitProblem problem;
  problem.parameters = {{.name = "slope", .unit = "", .first = 0.012, .lower = 1e-3, .upper = 0.1}};
  problem.residuals = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
    std::vector<double> residuals = line(p[0], last - 1);
    for (std::size_t i = 0; i < n; ++i) residuals[i] -= measured[i];
    return residuals;
  };
  const auto stray = stray_row(fit(problem, {.step = 1e-4}), {measured});
  ASSERT_TRUE(stray);
  EXPECT_NE(stray->row, last);
  EXPECT_GT(stray->probability, 1e-3);
}

// The first row of a record has no neighbours in the record before.
TEST(StrayRow, AtTheSeamOfTwoRecordsIsNone) {
  std::mt19937_64 engine(6);
  std::vector<double> noise = noisy_bar::noise("white", n, engine);
  noise[dropped] -= record(noise)[dropped] / 0.02;
  const FitResult result = fitted(noise);
  const std::vector<double> all = record(noise);
  const auto middle = all.begin() + dropped;
  const auto whole = stray_row(result, {all}), cut = stray_row(result, {{all.begin(), middle}, {middle, all.end()}});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->row, dropped);
  EXPECT_FALSE(cut && cut->row == dropped);
}

// Of a model that is wrong everywhere no row stands out by the noise alone.
TEST(StrayRow, OfAWrongModelWithKnownNoiseIsNone) {
  std::mt19937_64 engine(8);
  FitResult result = fitted(noisy_bar::noise("white", n, engine));
  const double sigma = result.rms;
  for (double& r : result.residuals) r *= 30.0 / sigma;
  result.sum_of_squares *= 900.0 / (sigma * sigma);
  result.noise_is_known = true;
  const auto stray = stray_row(result, {result.residuals});
  EXPECT_FALSE(stray && stray->probability < 1e-3);
}

// A load cell whose error is a share of the force.
TEST(StrayRow, IsNoneOfNoiseThatGrowsWithTheForce) {
  std::mt19937_64 engine(9);
  const std::vector<double> exact = record(std::vector<double>(n, 0.0));
  int told = 0, told_without_sizes = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<double> noise = noisy_bar::noise("white", n, engine);
    for (std::size_t i = 0; i < n; ++i) noise[i] *= 0.03 + std::pow(exact[i], 2);
    const FitResult result = fitted(noise);
    const auto stray = stray_row(result, {record(noise)}, exact), raw = stray_row(result, {record(noise)});
    told += stray && stray->probability < 1e-3 ? 1 : 0;
    told_without_sizes += raw && raw->probability < 1e-3 ? 1 : 0;
  }
  EXPECT_LE(told, 4) << "of 200";
  EXPECT_GT(told_without_sizes, 10);
}

TEST(StrayRow, OfFewRowsIsNotKnown) {
  std::mt19937_64 engine(7);
  const std::vector<double> noise = noisy_bar::noise("white", 7, engine);
  EXPECT_FALSE(stray_row(fitted(noise), {record(noise)}));
}

}  // namespace
}  // namespace pfdm::this_file
