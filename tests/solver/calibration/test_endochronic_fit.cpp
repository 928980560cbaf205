#include "solver/point/endochronic_identification.h"
#include "tests/solver/expected_parameters.h"
#include "tests/solver/independent_simulators.h"
#include "tests/solver/synthetic_experiments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

/// Off by up to a factor of two everywhere.
EndochronicLaw first_guess() {
  EndochronicLaw law = three_term_law();
  law.kernel = {{40e9, 2000.0}, {25e9, 300.0}, {3e9, 50.0}};
  law.hardening.with_path = saturating(2.0, 10.0);
  return law;
}

TEST(EndochronicFit, JointWithoutNoiseFindsTheTruth) {
  const EndochronicLaw truth = three_term_law();
  const std::vector<MaterialExperiment> data{measured(truth, eight_cycles(), {0}, 0.0, 1)};
  const EndochronicIdentification found = identification_method("joint").identify(first_guess(), data, {});
  std::printf("%d evaluations, rms %.3g Pa\n", found.fit.result.evaluations, rms_misfit(found.fit.law, data, {}));
  expect_parameters(found.fit.law, truth, 1e-6, 1e-6, 1e-6, 1e-6);
}

TEST(EndochronicFit, JointWithNoiseOfAFifthOfAPercent) {
  const EndochronicLaw truth = three_term_law();
  const std::vector<MaterialExperiment> data{measured(truth, eight_cycles(), {0}, 0.5e6, 2)};
  const EndochronicIdentification found = identification_method("joint").identify(first_guess(), data, {});
  expect_parameters(found.fit.law, truth, 0.01, 0.04, 0.03, 0.08);
  const std::vector<MaterialExperiment> clean{measured(truth, eight_cycles(), {0}, 0.0, 1)};
  const double curve = rms_misfit(found.fit.law, clean, {});
  std::printf("curve off by %.3g Pa rms, noise 5e5 Pa\n", curve);
  EXPECT_LT(curve, 0.5e6);
  for (const FitEstimate& estimate : found.fit.result.estimates) {
    EXPECT_GT(estimate.upper_95, estimate.value);
    EXPECT_LT(estimate.lower_95, estimate.value);
  }
}

TEST(EndochronicFit, FindsTheNumberOfTerms) {
  const EndochronicLaw truth = three_term_law();
  for (const double noise : {0.0, 0.5e6}) {
    const std::vector<MaterialExperiment> data{measured(truth, eight_cycles(331), {0}, noise, 3)};
    const EndochronicIdentification found =
        identification_method("joint").identify(first_guess(), data, {.least_terms = 1, .most_terms = 4});
    EXPECT_EQ(found.fit.law.kernel.size(), 3u);
    EXPECT_EQ(found.tried.size(), 4u);
  }
}

TEST(EndochronicFit, KernelAloneAtGivenHardening) {
  const EndochronicLaw truth = three_term_law();
  const std::vector<MaterialExperiment> data{measured(truth, eight_cycles(), {0}, 0.0, 1)};
  EndochronicLaw start = first_guess();
  start.hardening = truth.hardening;
  expect_parameters(identification_method("kernel").identify(start, data, {}).fit.law, truth, 1e-15, 1e-15, 1e-6, 1e-6);
}

TEST(EndochronicFit, TransientGivesTheHardeningPointByPoint) {
  const EndochronicLaw truth = three_term_law();
  EndochronicLaw start = truth;
  start.hardening.with_path = saturating(2.0, 10.0);
  const MaterialExperiment data = measured(truth, eight_cycles(), {0}, 0.0, 1);
  const std::vector<HardeningPoint> points = transient_hardening(start, data);
  ASSERT_EQ(points.size(), 660u);
  double largest = 0.0;
  for (const HardeningPoint& p : points)
    largest = std::max(largest, std::abs(p.f / truth.hardening(p.zeta, 0.0).f - 1.0));
  std::printf("largest relative error of f: %.2g\n", largest);
  EXPECT_LE(largest, 1e-11);
  const EndochronicIdentification found = identification_method("hardening").identify(start, {data}, {});
  EXPECT_NEAR(found.fit.law.hardening.with_path.p[0], 3.0, 1e-6);
  EXPECT_NEAR(found.fit.law.hardening.with_path.p[1], 6.0, 1e-6);
}

TEST(EndochronicFit, SeveralExperimentsAtSeveralRates) {
  EndochronicLaw truth = three_term_law();
  truth.hardening.with_rate = logarithmic_rate(0.02, 1e-4);
  std::vector<MaterialExperiment> data;
  const Path axial = [](double t) { return 0.004 * std::sin(2.0 * std::numbers::pi * t); };
  const Path shear = [](double t) { return 0.0035 * std::sin(2.0 * std::numbers::pi * t); };
  const Path shear_later = [](double t) { return 0.0035 * (1.0 - std::cos(2.0 * std::numbers::pi * t)); };
  const auto slowed = [](const Path& path, double factor) { return [=](double t) { return path(t / factor); }; };
  data.push_back(measured(truth, tension_path(axial, 160, 4.0), {0}, 0.0, 1));
  data.push_back(measured(truth, tension_path(slowed(axial, 1000.0), 160, 4000.0), {0}, 0.0, 1));
  data.push_back(measured(truth, strain_paths({Path(), {}, {}, {}, {}, shear}, 160, 4.0), {5}, 0.0, 1));
  data.push_back(measured(truth, strain_paths({axial, {}, {}, {}, {}, shear_later}, 160, 4.0), {0, 5}, 0.0, 1));
  EndochronicLaw start = first_guess();
  start.hardening.with_rate = logarithmic_rate(0.05, 1e-4);
  const EndochronicIdentification found =
      identification_method("joint").identify(start, data, {.choice = {.rate = true}});
  expect_parameters(found.fit.law, truth, 1e-6, 1e-6, 1e-6, 1e-6);
  EXPECT_NEAR(found.fit.law.hardening.with_rate.p[0], 0.02, 1e-7);

  // f at each increment, at both rates and under shear too, where the kernel is known.
  EndochronicLaw no_rate = truth;
  no_rate.hardening.with_rate = {&rate_factor("none"), {}};
  for (const MaterialExperiment& experiment : data)
    for (const HardeningPoint& p : transient_hardening(truth, experiment))
      ASSERT_NEAR(p.f / truth.hardening(p.zeta, p.rate).f, 1.0, 1e-5);
}

TEST(EndochronicFit, StaggeredComesNearButJointIsBetter) {
  const EndochronicLaw truth = three_term_law();
  const std::vector<MaterialExperiment> data{measured(truth, eight_cycles(331), {0}, 0.1e6, 4)};
  const EndochronicIdentification staggered =
      identification_method("staggered").identify(first_guess(), data, {.maximum_rounds = 8});
  const EndochronicIdentification joint = identification_method("joint").identify(first_guess(), data, {});
  const double s = rms_misfit(staggered.fit.law, data, {}), j = rms_misfit(joint.fit.law, data, {});
  std::printf("rms misfit: staggered %.4g Pa after %zu rounds, joint %.4g Pa, at the beginning %.4g Pa\n", s,
              staggered.rounds.size(), j, rms_misfit(first_guess(), data, {}));
  EXPECT_LT(s, 0.1 * rms_misfit(first_guess(), data, {}));
  EXPECT_LE(j, s * (1.0 + 1e-9));
}

/// Eight cycles of an independent simulator, noise of so much of the rms stress.
MaterialExperiment independent_cycles(double noise, unsigned seed) {
  const std::vector<double> strain = independent::triangles(0.006, 8, 80);
  const std::vector<double> stress = independent::stress_of({}, strain, 100);
  double square = 0.0;
  for (const double s : stress) square += s * s / static_cast<double>(stress.size());
  return independent::tension_test(strain, stress, noise * std::sqrt(square), seed);
}

EndochronicLaw two_term_law(const Kernel& kernel) {
  EndochronicLaw law{.elasticity = from_young_poisson(100e9, 0.3), .kernel = kernel, .hardening = {}};
  law.hardening.with_path = saturating(1.4, 15.0);
  return law;
}

TEST(EndochronicFit, HardeningIsNotBiasedByNoise) {
  for (const double noise : {4e-4, 4e-3}) {
    constexpr int trials = 12;
    double off_f = 0.0, off_b = 0.0;
    for (unsigned seed = 1; seed <= trials; ++seed) {
      const EndochronicIdentification found =
          identification_method("hardening")
              .identify(two_term_law({{30e9, 700.0}, {4e9, 60.0}}), {independent_cycles(noise, seed)}, {});
      ASSERT_EQ(found.fit.result.estimates.size(), 2u);
      const FitEstimate &f_inf = found.fit.result.estimates[0], &b = found.fit.result.estimates[1];
      EXPECT_NEAR(f_inf.value, 1.8, 4.0 * f_inf.standard_error) << seed;
      EXPECT_NEAR(b.value, 9.0, 4.0 * b.standard_error) << seed;
      off_f += (f_inf.value - 1.8) / f_inf.standard_error / trials;
      off_b += (b.value - 9.0) / b.standard_error / trials;
    }
    EXPECT_LT(std::abs(off_f), 3.0 / std::sqrt(trials));
    EXPECT_LT(std::abs(off_b), 3.0 / std::sqrt(trials));
  }
}

// With the curve's own increments of 4e-4 and little noise, the steps of the model move the estimates: by no more than
// is said, and not by much less. Quarter steps leave a sixteenth.
TEST(EndochronicFit, SaysHowFarItsStepsMoveTheEstimates) {
  const std::vector<double> strain = independent::triangles(0.008, 8, 80);
  const std::vector<double> stress = independent::stress_of({}, strain, 100);
  double square = 0.0;
  for (const double s : stress) square += s * s / static_cast<double>(stress.size());
  const std::vector<MaterialExperiment> data{independent::tension_test(strain, stress, 4e-4 * std::sqrt(square), 1)};
  const EndochronicLaw start = two_term_law({{30e9, 700.0}, {4e9, 60.0}});
  const ControlSettings finer{.substeps = 4};
  const LawFit coarse = identification_method("hardening").identify(start, data, {}).fit;
  const LawFit fine = identification_method("hardening").identify(start, data, {.control = finer}).fit;
  const auto effect = effect_of_steps(coarse, data, {}), left = effect_of_steps(fine, data, finer);
  ASSERT_TRUE(effect && left);
  EXPECT_NEAR(*left / *effect, 1.0 / 16.0, 0.02);
  double largest = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const FitEstimate &a = coarse.result.estimates[i], &b = fine.result.estimates[i];
    largest = std::max(largest, std::abs(a.value - b.value) / a.standard_error);
  }
  std::printf("steps move the estimates by %.3g standard errors, by %.3g at most\n", largest, *effect);
  EXPECT_LE(largest, 1.1 * *effect);
  EXPECT_GE(largest, 0.2 * *effect);
}

// The same data: the steps are divided until what is left of their error does not matter.
TEST(EndochronicFit, DividesItsStepsAsFarAsTheNoiseAsksFor) {
  const std::vector<double> strain = independent::triangles(0.008, 8, 80);
  const std::vector<double> stress = independent::stress_of({}, strain, 100);
  double square = 0.0;
  for (const double s : stress) square += s * s / static_cast<double>(stress.size());
  const auto test = [&](double noise) {
    return std::vector{independent::tension_test(strain, stress, noise * std::sqrt(square), 1)};
  };
  const EndochronicLaw start = two_term_law({{30e9, 700.0}, {4e9, 60.0}});
  std::vector<int> substeps;
  for (const double noise : {4e-4, 1e-2}) {
    const auto data = test(noise);
    EndochronicIdentification found = identification_method("hardening").identify(start, data, {});
    const std::vector<FitEstimate> before = found.fit.result.estimates;
    ControlSettings control;
    divide_steps(found, data, {}, control);
    substeps.push_back(control.substeps);
    const LawFit fine = identification_method("hardening").identify(start, data, {.control = {.substeps = 16}}).fit;
    for (std::size_t j = 0; j < before.size(); ++j)
      EXPECT_NEAR(found.fit.result.estimates[j].value, fine.result.estimates[j].value, 0.2 * before[j].standard_error);
  }
  EXPECT_GT(substeps[0], 1);
  EXPECT_EQ(substeps[1], 1) << "noise of 1 % hides the error of the steps";
}

// The rounds of the report's scheme end on no estimate; those of the joint fit hold the truth.
TEST(EndochronicFit, StaggeredPassesOverToTheJointFit) {
  const std::map<std::string, double> truth{{"C_1", 30e9},     {"alpha_1", 700.0}, {"C_2", 4e9},
                                            {"alpha_2", 60.0}, {"f_inf", 1.8},     {"b", 9.0}};
  const EndochronicIdentification found =
      identification_method("staggered")
          .identify(two_term_law({{20e9, 1000.0}, {6e9, 40.0}}), {independent_cycles(4e-3, 1)}, {});
  EXPECT_THAT(found.remark, testing::HasSubstr("went to and fro and did not settle"));
  EXPECT_THAT(found.remark, testing::HasSubstr("the estimates are those of the joint fit"));
  ASSERT_EQ(found.fit.parameters.size(), truth.size());
  for (std::size_t j = 0; j < truth.size(); ++j) {
    const FitEstimate& e = found.fit.result.estimates[j];
    EXPECT_NEAR(e.value, truth.at(found.fit.parameters[j].name), 4.0 * e.standard_error)
        << found.fit.parameters[j].name;
  }
}

}  // namespace
}  // namespace pfdm::this_file
