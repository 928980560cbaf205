#include "solver/point/mixed_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/physics/endochronic_laws.h"
#include "tests/solver/loadings.h"

namespace pfdm::this_file {
namespace {

using Conditions = std::array<ControlCondition, 6>;

Mandel values_of(const Conditions& conditions, const Mandel& stress, const Mandel& strain) {
  Mandel values;
  for (int k = 0; k < n_components; ++k) {
    const ControlCondition& c = conditions[k];
    values[k] = c.on_stress.dot(stress) + c.on_strain.dot(strain);
  }
  return values;
}

/// Six of the twelve components at random; patterns that cannot determine a step are drawn again.
Conditions random_pattern(RandomEndochronic& random, const EndochronicLaw& law) {
  while (true) {
    std::array<int, 12> order;
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = 11; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)))]);
    Conditions conditions;
    for (std::size_t k = 0; k < 6; ++k) conditions[k] = order[k] < 6 ? on_strain(order[k]) : on_stress(order[k] - 6);
    if (!dependent_conditions(law, conditions)) return conditions;
  }
}

// The prescribed values are those of a response to a strain increment: a solution exists.
TEST(EndochronicControl, RandomPatternsOfSixComponents) {
  RandomEndochronic random;
  const EndochronicLaw law = three_term_law();
  int most = 0, total = 0, failures = 0;
  double largest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    EndochronicState state = virgin_state(law);
    for (int j = 0; j < 3; ++j) state = update(law, state, 3e-3 * random.direction(), 1.0).state;
    const Conditions conditions = random_pattern(random, law);
    const double size = random.log_uniform(1e-6, 3e-3);
    const EndochronicUpdate wanted = update(law, state, size * random.direction(), 1.0);
    const Mandel before = values_of(conditions, stress(law, state), state.strain);
    const Mandel after = values_of(conditions, wanted.stress, wanted.state.strain);
    const ControlledStep step = controlled_step(law, state, conditions, after - before, 1.0);
    failures += step.converged ? 0 : 1;
    if (!step.converged) continue;
    const Mandel found = values_of(conditions, step.update.stress, step.update.state.strain);
    for (int k = 0; k < n_components; ++k) {
      const double unit = conditions[k].on_stress.isZero() ? 1.0 : law.elasticity.mu;
      largest = std::max(largest, std::abs(found[k] - after[k]) / (unit * size));
    }
    most = std::max(most, step.iterations);
    total += step.iterations;
  }
  std::printf("iterations: mean %.2f, most %d; largest error %.2g; failures %d\n", total / 1000.0, most, largest,
              failures);
  EXPECT_EQ(failures, 0);
  EXPECT_LE(most, 8);
  EXPECT_LE(largest, 1e-9);
}

TEST(EndochronicControl, StressAndStrainOfOneComponentWithAnotherFree) {
  const EndochronicLaw law = three_term_law();
  const Conditions conditions{on_strain(0), on_stress(0), on_stress(2), on_stress(3), on_stress(4), on_strain(5)};
  const Mandel change{1e-3, 150e6, 0.0, 0.0, 0.0, 0.0};
  const ControlledStep step = controlled_step(law, virgin_state(law), conditions, change, 1.0);
  ASSERT_TRUE(step.converged);
  EXPECT_NEAR(step.update.state.strain[0], 1e-3, 1e-14);
  EXPECT_NEAR(step.update.stress[0], 150e6, 1e-3);
  EXPECT_GT(std::abs(step.update.stress[1]), 1e6);  // what the free pair has to bear
}

TEST(EndochronicControl, TellsConditionsThatDependOnEachOther) {
  const EndochronicLaw law = one_term_law();
  Conditions conditions;
  for (int k = 0; k < 6; ++k) conditions[k] = on_strain(k);
  EXPECT_FALSE(dependent_conditions(law, conditions));
  conditions[5] = on_strain(0);
  EXPECT_THAT(dependent_conditions(law, conditions).value_or(""), testing::HasSubstr("rank 5 of 6"));
  conditions[5] = {};
  EXPECT_THAT(dependent_conditions(law, conditions).value_or(""),
              testing::HasSubstr("condition 6 contains neither stress nor strain"));
}

TEST(EndochronicControl, LinearConditionBetweenIncrements) {
  // Undrained: d eps_xx + d eps_yy + d eps_zz = 0, with d sigma_yy = d sigma_zz.
  const EndochronicLaw law = three_term_law();
  LoadSegment segment = tension_path([](double t) { return 0.01 * t; }, 50);
  segment.conditions[1] = {{Mandel::Zero(), mandel_identity()}, Pace::increment, std::vector<double>(51, 0.0)};
  segment.conditions[2] = {
      {Mandel(Mandel::Unit(1) - Mandel::Unit(2)), Mandel::Zero()}, Pace::increment, std::vector<double>(51, 0.0)};
  const HistoryResult result = run_history(law, {segment});
  ASSERT_TRUE(result.converged) << result.failure;
  const HistoryPoint& last = result.points.back();
  EXPECT_NEAR(trace(last.state.strain), 0.0, 1e-12);
  EXPECT_NEAR(last.stress[1], last.stress[2], 1e-3);
  EXPECT_NEAR(trace(last.stress), 0.0, 1.0);  // no volume, no pressure
  EXPECT_GT(last.stress[0], 1e8);
}

TEST(EndochronicControl, RampsStartWhereTheSegmentBefore) {
  const EndochronicLaw law = three_term_law();
  LoadSegment loading = tension_path([](double t) { return 0.01 * t; }, 20);
  LoadSegment unloading = loading;
  unloading.conditions[0] = {on_stress(0), Pace::ramp, {0.0}};
  const HistoryResult result = run_history(law, {loading, unloading});
  ASSERT_TRUE(result.converged) << result.failure;
  const double peak = result.points[20].stress[0];
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(result.points[20 + i].stress[0], peak * (1.0 - i / 20.0), 1e-9 * peak);
  EXPECT_NEAR(result.points.back().time, 2.0, 1e-15);
}

TEST(EndochronicControl, StressBeyondSaturationIsReportedAsSuch) {
  const EndochronicLaw law = one_term_law();  // tension saturates at 104.978 MPa
  LoadSegment segment = tension_path([](double t) { return 200e6 * t; }, 10);
  segment.conditions[0].condition = on_stress(0);
  const HistoryResult result = run_history(law, {segment});
  EXPECT_FALSE(result.converged);
  EXPECT_THAT(result.failure, testing::HasSubstr("beyond the saturation surface"));
  EXPECT_THAT(result.failure, testing::HasSubstr("t = 0.6 s"));
  EXPECT_EQ(result.points.size(), 6u);  // 0, 20 ... 100 MPa
}

TEST(EndochronicControl, CutsPrescribedStrainsIntoSubsteps) {
  const EndochronicLaw law = three_term_law();
  const LoadSegment segment = tension_path([](double t) { return 0.01 * t; }, 5);
  const HistoryResult coarse = run_history(law, {segment}, {.largest_increment = 1e-4 * (1.0 + 1e-9)});
  const HistoryResult fine = run_history(law, {tension_path([](double t) { return 0.01 * t; }, 100)});
  ASSERT_TRUE(coarse.converged && fine.converged);
  EXPECT_EQ(coarse.points.back().substeps, 20);
  EXPECT_NEAR(coarse.points.back().stress[0], fine.points.back().stress[0], 1e-9 * fine.points.back().stress[0]);
  const HistoryResult both = run_history(law, {segment}, {.largest_increment = 4e-4 * (1.0 + 1e-9), .substeps = 4});
  EXPECT_EQ(both.points.back().substeps, 20);
  EXPECT_NEAR(both.points.back().stress[0], fine.points.back().stress[0], 1e-9 * fine.points.back().stress[0]);
}

TEST(EndochronicControl, CutsHeldTimesIntoSubsteps) {
  EndochronicLaw law = three_term_law();
  law.hardening.with_rate = logarithmic_rate(0.2, 1e-4);
  const auto held = [&](int steps, int substeps) {
    const LoadSegment loaded = tension_path([](double t) { return 0.01 * t; }, 10 * steps),
                      kept = tension_path([](double) { return 0.01; }, steps, 10.0);
    const HistoryResult result = run_history(law, {loaded, kept}, {.substeps = substeps});
    EXPECT_TRUE(result.converged) << result.failure;
    EXPECT_LT(result.points.back().stress[0], 0.95 * result.points[10 * steps].stress[0]);
    return result.points.back().stress[0];
  };
  EXPECT_NEAR(held(1, 40), held(40, 1), 1e-9 * held(40, 1));
}

/// Stress in tension, reached in 1 s in 100 increments and held so long in so many.
HistoryResult held_stress(const EndochronicLaw& law, double stress, double time, int increments) {
  LoadSegment loaded = tension_path([=](double t) { return stress * t; }, 100),
              kept = tension_path([=](double) { return stress; }, increments, time);
  loaded.conditions[0].condition = kept.conditions[0].condition = on_stress(0);
  return run_history(law, {loaded, kept});
}

double strain_crept(const EndochronicLaw& law, double stress, int increments) {
  const HistoryResult result = held_stress(law, stress, 1000.0, increments);
  EXPECT_TRUE(result.converged) << result.failure;
  return result.points.back().state.strain[0];
}

// 60 GPa / 3000: a single term. With so few increments plastic paths are longer than 0.1.
TEST(EndochronicControl, CreepsInLongIncrementsToo) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{60e9, 3000.0}};
  law.hardening.with_rate = logarithmic_rate(0.1, 1e-4);
  const auto crept = [&](int increments) { return strain_crept(law, 58e6, increments); };
  const double fine = crept(1000);
  EXPECT_GT(fine, 0.4);
  EXPECT_NEAR(crept(4), fine, 0.01 * fine);
}

TEST(EndochronicControl, CreepsUnderATableOfPathAndRate) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{60e9, 3000.0}};
  law.hardening.with_path =
      make_factor(hardening_law("table_with_rate"),
                  rate_table_parameters({0.0, 0.2}, {1e-5, 1e-3, 1.0}, {1.0, 1.1, 1.3, 1.4, 1.6, 1.7}));
  const auto crept = [&](int increments) { return strain_crept(law, 60e6, increments); };
  const double fine = crept(1000);
  EXPECT_GT(fine, 0.1);
  EXPECT_NEAR(crept(1), fine, 0.05 * fine);
  EXPECT_NEAR(crept(4), fine, 0.05 * fine);
}

// Beyond a path of 0.05 the law bears less than the stress at any rate: long increments must not end with no creep.
TEST(EndochronicControl, CreepsWhereTheLawSoftensUntilItBearsNoMore) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{60e9, 3000.0}};
  law.hardening.with_path = make_factor(hardening_law("table_with_rate"),
                                        rate_table_parameters({0.0, 0.05}, {1e-5, 1e-2}, {1.0, 0.5, 1.5, 0.75}));
  const HistoryResult result = held_stress(law, 58e6, 1000.0, 10);
  EXPECT_FALSE(result.converged);
  const HistoryResult before = held_stress(law, 58e6, 1.0, 100);
  ASSERT_TRUE(before.converged) << before.failure;
  EXPECT_GT(before.points.back().state.strain[0], 1.01 * before.points[100].state.strain[0]);
}

// Without an end the strain would grow for ever, in ever smaller steps.
TEST(EndochronicControl, EndsWhereTheLawCannotFollowAStress) {
  EndochronicLaw law = one_term_law();
  law.kernel = {{100e9, 15000.0}, {10e9, 1000.0}};
  law.hardening = {.with_path = saturating(1.4, 60.0), .with_rate = logarithmic_rate(0.1, 1e-4)};
  const HistoryResult result = held_stress(law, 140e6, 100.0, 100);
  EXPECT_FALSE(result.converged);
  EXPECT_THAT(result.failure, testing::HasSubstr("the law cannot bear the prescribed stress"));
  EXPECT_LT(result.points.back().state.strain.norm(), 2.0);
}

}  // namespace
}  // namespace pfdm::this_file
