// Fits of the endochronic law with a hardening over path and rate, by tables and by tests that are held.

#include "solver/point/endochronic_identification.h"
#include "tests/solver/expected_parameters.h"
#include "tests/solver/independent_simulators.h"
#include "tests/solver/synthetic_experiments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace pfdm::this_file {
namespace {

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
