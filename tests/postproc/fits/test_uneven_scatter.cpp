// Residuals whose noise is even, or grows with the force, by repetition.

#include "postproc/fits/fit_judgement.h"
#include "postproc/fits/record_doubts.h"
#include "postproc/fits/uneven_scatter.h"
#include "tests/solver/noisy_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

constexpr std::size_t n = 100;

/// Forces of the bar over the strength.
std::vector<double> forces() {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = noisy_bar::range * static_cast<double>(i) / static_cast<double>(n - 1);
    values.push_back(noisy_bar::force(u, noisy_bar::truth[0], noisy_bar::truth[1], noisy_bar::truth[2]) /
                     (noisy_bar::area * noisy_bar::truth[1]));
  }
  return values;
}

/// Of the model that meets what noisy_bar::problem() takes for measured.
std::vector<double> sizes(std::vector<double> record, const FitResult& result) {
  for (std::size_t i = 0; i < record.size(); ++i) record[i] = std::abs(record[i] + result.residuals[i]);
  return record;
}
std::vector<double> sizes(const std::vector<double>& forces, const std::vector<double>& noise,
                          const FitResult& result) {
  std::vector<double> record = forces;
  for (std::size_t i = 0; i < record.size(); ++i) record[i] += 0.02 * noise[i];
  return sizes(record, result);
}

struct Repeated {
  int told = 0;                  // with a probability below 0.002
  int held = 0, held_wider = 0;  // intervals of the strength that hold the truth, as they are and widened
  double widening = 0.0;         // of the strength's, mean
};

/// 200 fits to the bar whose noise is `even` plus `by_force` times the force, in multiples of 2 % of the largest.
Repeated repeated(double even, double by_force) {
  constexpr int times = 200;
  Repeated all;
  std::mt19937_64 engine(5);
  const std::vector<double> size = forces();
  for (int k = 0; k < times; ++k) {
    std::vector<double> noise = noisy_bar::noise("white", n, engine);
    for (std::size_t i = 0; i < n; ++i) noise[i] *= even + by_force * size[i];
    const FitResult result = fit(noisy_bar::problem(noise), {.step = 1e-4});
    const UnevenScatter found = uneven_scatter(result, sizes(size, noise, result));
    all.told += found.probability < 0.002 ? 1 : 0;
    all.widening += found.widening[1] / times;
    const FitEstimate& strength = result.estimates[1];
    const double reach = student_95(found.freedom) * strength.standard_error / strength.value,
                 error = std::abs(std::log(strength.value / noisy_bar::truth[1]));
    all.held += error < reach ? 1 : 0;
    all.held_wider += error < found.widening[1] * reach ? 1 : 0;
  }
  return all;
}

TEST(UnevenScatter, OfEvenNoiseIsHardlyEverTold) {
  const Repeated found = repeated(1.0, 0.0);
  EXPECT_LE(found.told, 3) << "of 200";
  EXPECT_LT(found.widening, 1.2);
  EXPECT_GE(found.held, 180);
}

// One row in ten bears load, and the noise has heavy tails.
TEST(UnevenScatter, OfEvenNoiseIsHardlyEverToldWhereFewRowsBearLoad) {
  std::mt19937_64 engine(8);
  std::student_t_distribution<double> heavy(3.0);
  int told = 0;
  for (int k = 0; k < 400; ++k) {
    std::vector<double> size(n, 0.0), record;
    for (std::size_t i = 0; i < n / 10; ++i) size[i] = 0.1 * static_cast<double>(i);
    for (std::size_t i = 0; i < n; ++i) record.push_back(size[i] + 0.02 * heavy(engine));
    FitProblem problem;
    problem.parameters = {{.name = "slope", .unit = "", .first = 1.1, .lower = 0.1, .upper = 10.0}};
    problem.residuals = [&](std::span<const double> p) -> std::optional<std::vector<double>> {
      std::vector<double> residuals;
      for (std::size_t i = 0; i < n; ++i) residuals.push_back(p[0] * size[i] - record[i]);
      return residuals;
    };
    const FitResult result = fit(problem, {.step = 1e-4});
    const UnevenScatter found = uneven_scatter(result, sizes(record, result));
    told += found.probability < 0.002 && found.widest() > 1.25 ? 1 : 0;
  }
  EXPECT_LE(told, 3) << "of 400";
}

// The strength rests on the rows with the largest forces.
TEST(UnevenScatter, OfNoiseThatGrowsWithTheForceIsToldAndWidensIntervalsThatWouldBeTooNarrow) {
  const Repeated found = repeated(0.05, 1.0);
  EXPECT_GE(found.told, 180) << "of 200";
  EXPECT_GT(found.widening, 1.25);
  EXPECT_LT(found.held, 180);
  EXPECT_GE(found.held_wider, 180);
  EXPECT_LE(found.held_wider, 198);
}

TEST(UnevenScatter, HasTheRmsOfSmallAndLargeForces) {
  std::mt19937_64 engine(6);
  std::vector<double> noise = noisy_bar::noise("white", n, engine);
  const std::vector<double> size = forces();
  std::vector<double> sorted = size;
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < n; ++i) noise[i] *= size[i] < sorted[n / 2] ? 1.0 : 3.0;
  const FitResult result = fit(noisy_bar::problem(noise), {.step = 1e-4});
  const UnevenScatter found = uneven_scatter(result, sizes(size, noise, result));
  EXPECT_NEAR(found.small, 0.02, 0.006);
  EXPECT_NEAR(found.large, 0.06, 0.018);
  EXPECT_LT(found.probability, 0.01);
}

// Of a sound fit, also of one within the error of its mesh; not of one whose intervals are wider already.
TEST(UnevenScatter, WidensIntervalsOnce) {
  std::mt19937_64 engine(5);
  std::vector<double> noise = noisy_bar::noise("white", n, engine);
  const std::vector<double> size = forces();
  for (std::size_t i = 0; i < n; ++i) noise[i] *= 0.02 + std::pow(size[i], 4);
  const FitProblem problem = noisy_bar::problem(noise);
  const FitResult result = fit(problem, {.step = 1e-4});
  const std::vector<FittedRecord> records{{.measured = {}, .size = sizes(size, noise, result), .row = {}}};
  const auto widening = [&](Verdict verdict, bool is_correlated) {
    FitFindings found = findings_of(problem.parameters, result);
    found.verdict = verdict;
    if (is_correlated) widen(found.parameters[1], 1.0, 10.0);
    widen_for_uneven_scatter(result, records, 0.0, "", found);
    return found.parameters[1].widened_by;
  };
  EXPECT_GT(widening(Verdict::sound, false), 1.25);
  EXPECT_EQ(widening(Verdict::discretised, false), widening(Verdict::sound, false));
  EXPECT_EQ(widening(Verdict::correlated, true), 1.0);
  EXPECT_EQ(widening(Verdict::questionable, false), 1.0);
}

// Correlated residuals may leave fewer degrees of freedom, and the standard error as it is.
TEST(UnevenScatter, OfAWidenedIntervalReachesAsFarAsItsEnds) {
  FittedParameter p{.name = "p", .unit = "1", .estimate = 5.0, .standard_error = 1.0};
  EXPECT_FALSE(reach_of_widened(p));
  widen(p, 1.0, 10.0);
  ASSERT_TRUE(reach_of_widened(p));
  EXPECT_NEAR(*reach_of_widened(p), 2.228, 1e-3);
  EXPECT_NEAR(p.upper, 5.0 + *reach_of_widened(p), 1e-12);
}

TEST(UnevenScatter, OfFewValuesIsNotKnown) {
  std::mt19937_64 engine(7);
  const FitResult result = fit(noisy_bar::problem(noisy_bar::noise("white", 12, engine)), {.step = 1e-4});
  EXPECT_EQ(uneven_scatter(result, std::vector<double>(12, 1.0)).probability, 1.0);
}

}  // namespace
}  // namespace pfdm::this_file
