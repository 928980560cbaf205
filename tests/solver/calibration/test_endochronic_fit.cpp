#include "solver/point/endochronic_identification.h"
#include "tests/solver/independent_simulators.h"
#include "tests/solver/synthetic_experiments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

namespace pfdm::this_file {
namespace {

/// Off by up to a factor of two everywhere.
EndochronicLaw first_guess() {
  EndochronicLaw law = three_term_law();
  law.kernel = {{40e9, 2000.0}, {25e9, 300.0}, {3e9, 50.0}};
  law.hardening.with_path = saturating(2.0, 10.0);
  return law;
}

void expect_parameters(const EndochronicLaw& found, const EndochronicLaw& truth, double f_inf, double b, double C,
                       double alpha) {
  ASSERT_EQ(found.kernel.size(), truth.kernel.size());
  for (std::size_t r = 0; r < truth.kernel.size(); ++r) {
    EXPECT_NEAR(found.kernel[r].C / truth.kernel[r].C, 1.0, C) << "term " << r + 1;
    EXPECT_NEAR(found.kernel[r].alpha / truth.kernel[r].alpha, 1.0, alpha) << "term " << r + 1;
  }
  EXPECT_NEAR(found.hardening.with_path.p[0] / truth.hardening.with_path.p[0], 1.0, f_inf);
  EXPECT_NEAR(found.hardening.with_path.p[1] / truth.hardening.with_path.p[1], 1.0, b);
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

TEST(EndochronicFit, TableOfHardening) {
  EndochronicLaw truth = three_term_law();
  truth.hardening.with_path = make_factor(hardening_law("table"), {0.0, 0.05, 0.3, 1.0, 1.5, 2.2});
  const std::vector<MaterialExperiment> data{measured(truth, eight_cycles(), {0}, 0.0, 1)};
  EndochronicLaw start = truth;
  start.hardening.with_path = make_factor(hardening_law("table"), {0.0, 0.05, 0.3, 1.0, 1.1, 1.3});
  const EndochronicIdentification found = identification_method("joint").identify(start, data, {});
  EXPECT_NEAR(found.fit.law.hardening.with_path.p[4], 1.5, 1e-6);
  EXPECT_NEAR(found.fit.law.hardening.with_path.p[5], 2.2, 1e-5);
  EXPECT_EQ(found.fit.law.hardening.with_path.p[3], 1.0);  // the gauge
}

// A5.2.2: f over path and rate from tests at three rates, by all at once and from the transient response.
TEST(EndochronicFit, TableOfPathAndRate) {
  const std::vector<double> zeta{0.0, 0.01, 0.05}, rate{1e-5, 1e-3, 1e-1};
  const auto with_table = [&](const std::vector<double>& f) {
    EndochronicLaw law = three_term_law();
    law.hardening.with_path = make_factor(hardening_law("table_with_rate"), rate_table_parameters(zeta, rate, f));
    return law;
  };
  const std::vector<double> true_f{1.0, 1.3, 1.8, 1.1, 1.5, 2.0, 1.2, 1.6, 2.4};
  const EndochronicLaw truth = with_table(true_f), start = with_table(std::vector<double>(9, 1.0));
  std::vector<MaterialExperiment> data;
  for (const double duration : {4000.0, 60.0, 0.5}) {
    const Path path = [&](double t) { return 0.006 * std::sin(8.0 * std::numbers::pi * t / duration); };
    data.push_back(measured(truth, tension_path(path, 240, duration), {0}, 0.0, 1));
  }
  for (const char* method : {"joint", "hardening"}) {
    SCOPED_TRACE(method);
    const EndochronicIdentification found = identification_method(method).identify(start, data, {});
    const RateTable table = rate_table(found.fit.law.hardening.with_path.p);
    for (std::size_t i = 0; i < true_f.size(); ++i) EXPECT_NEAR(table.f[i], true_f[i], 1e-4) << i;
    EXPECT_EQ(table.f[0], 1.0);  // the gauge
    EXPECT_EQ(found.fit.parameters.back().name, "f_3_3");
  }
}

/// Loaded at a constant rate in 40 steps of time, then held at times that grow by a tenth.
LoadSegment loaded_and_held(double rate, double loading, double held) {
  LoadSegment segment = tension_path([=](double t) { return rate * t; }, 40, loading);
  auto& values = segment.conditions[0].values;
  for (double step = 0.02 * loading; segment.times.back() < loading + held; step *= 1.1) {
    segment.times.push_back(segment.times.back() + step);
    values.push_back(rate * loading);
  }
  for (auto& condition : segment.conditions) condition.values.resize(segment.times.size(), 0.0);
  return segment;
}

// Three tests on one material: a rate that jumps, a strain that is held, a stress that is held.
TEST(EndochronicFit, RateJumpsRelaxationAndCreepAtOnce) {
  EndochronicLaw truth = one_term_law();
  truth.kernel = {{300e9, 15000.0}, {30e9, 1000.0}};
  truth.hardening = {.with_path = saturating(1.4, 60.0), .with_rate = logarithmic_rate(0.1, 1e-4)};
  LoadSegment jumps = tension_path([](double t) { return 1e-4 * t; }, 60, 60.0);
  for (int i = 1; i <= 60; ++i) {
    jumps.times.push_back(60.0 + 0.01 * i);
    for (auto& condition : jumps.conditions) condition.values.push_back(0.0);
    jumps.conditions[0].values.back() = 0.006 + 1e-4 * i;
  }
  LoadSegment creep = loaded_and_held(140e6, 1.0, 1000.0);
  creep.conditions[0].condition = on_stress(0);
  EndochronicLaw start = truth;
  start.kernel = {{200e9, 9000.0}, {45e9, 1500.0}};
  start.hardening = {.with_path = saturating(1.2, 30.0), .with_rate = logarithmic_rate(0.06, 1e-4)};
  for (const double noise : {0.0, 0.005}) {
    const std::vector<MaterialExperiment> data{
        measured(truth, jumps, {0}, noise * 150e6, 1),
        measured(truth, loaded_and_held(0.01, 1.0, 1000.0), {0}, noise * 150e6, 2),
        measured(truth, creep, {0}, noise * 0.005, 3, true)};
    const EndochronicIdentification found =
        identification_method("joint").identify(start, data, {.choice = {.rate = true}});
    if (noise == 0.0) {
      expect_parameters(found.fit.law, truth, 1e-5, 1e-5, 1e-5, 1e-5);
      EXPECT_NEAR(found.fit.law.hardening.with_rate.p[0], 0.1, 1e-6);
      EXPECT_LT(relative_misfit(found.fit.law, data, {}), 1e-6);
      continue;
    }
    EndochronicIdentificationSettings exactly{.choice = {.rate = true}};
    exactly.fit.differences = Differences::central;
    exactly.fit.step = 1e-4;
    const LawFit by_central = identification_method("joint").identify(found.fit.law, data, exactly).fit;
    const std::vector<double> expected{300e9, 15000.0, 30e9, 1000.0, 1.4, 60.0, 0.1};
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const FitEstimate& e = found.fit.result.estimates[i];
      EXPECT_NEAR(e.value, expected[i], 4.0 * (e.upper_95 - e.lower_95) / 3.92) << found.fit.parameters[i].name;
      // The equations of what comes to rest are nearly singular: short differences made intervals too narrow by a
      // quarter.
      EXPECT_NEAR(e.standard_error / by_central.result.estimates[i].standard_error, 1.0, 0.03);
    }
    EXPECT_NEAR(found.fit.result.sum_of_squares, static_cast<double>(n_measured(data)),
                0.2 * static_cast<double>(n_measured(data)));
  }
}

}  // namespace
}  // namespace pfdm::this_file
