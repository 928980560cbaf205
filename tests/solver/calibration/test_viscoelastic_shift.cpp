// Prony branches and the shift of their times by the temperature, estimated from tests at several temperatures.

#include "solver/point/viscoelastic_identification.h"
#include "tests/solver/synthetic_relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

constexpr double reference = 298.15;  // [K]
constexpr TemperatureShift wlf{.law = TemperatureShift::Law::wlf, .reference = reference, .c1 = 8.9, .c2 = 101.6};
constexpr TemperatureShift arrhenius{
    .law = TemperatureShift::Law::arrhenius, .reference = reference, .activation_energy = 80e3};

/// The series with its times at a temperature [K].
PronyLaw at(PronyLaw law, double factor) {
  for (PronyBranch& branch : law.shear) branch.time *= factor;
  return law;
}

/// a_T by hand.
double wlf_factor(double T) { return std::pow(10.0, -8.9 * (T - reference) / (101.6 + T - reference)); }
double arrhenius_factor(double T) { return std::exp(80e3 / 8.314462618 * (1.0 / T - 1.0 / reference)); }

/// DMA of 0.01 to 100 Hz at seven temperatures, in one table.
ViscoelasticExperiment dma(double noise, unsigned seed) {
  ViscoelasticExperiment all;
  for (int k = 0; k < 7; ++k) {
    const double T = 233.15 + 20.0 * k;
    const ViscoelasticExperiment one =
        frequency_sweep(at(true_series, wlf_factor(T)), noise, seed + static_cast<unsigned>(100 * k));
    if (k == 0) {
      all = one;
      all.temperatures.assign(one.angular_frequencies.size(), T);
      continue;
    }
    const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(all.angular_frequencies, one.angular_frequencies);
    all.temperatures.insert(all.temperatures.end(), one.angular_frequencies.size(), T);
    for (std::size_t c = 0; c < one.channels.size(); ++c) append(all.channels[c].values, one.channels[c].values);
  }
  return all;
}

ViscoelasticIdentification identified(const ViscoelasticExperiments& tests, const TemperatureShift& guess, int most) {
  ViscoelasticSettings settings{.least_branches = 1, .most_branches = most};
  settings.choice.shift = true;
  const PronyLaw first{.relaxed = from_young_poisson(1e6, 0.49), .shear = {{1e6, 1.0}}, .shift = guess};
  return identify(first, tests, settings);
}

TEST(ViscoelasticShift, OfWlfIsFoundFromUniversalConstants) {
  TemperatureShift guess = wlf;
  guess.c1 = 17.44, guess.c2 = 51.6;
  const ViscoelasticIdentification exact = identified({dma(0.0, 1)}, guess, 4);
  ASSERT_EQ(exact.fit.law.shear.size(), 3u);
  EXPECT_NEAR(exact.fit.law.shift->c1, 8.9, 1e-4);
  EXPECT_NEAR(exact.fit.law.shift->c2, 101.6, 1e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(exact.fit.law.shear[i].modulus / true_series.shear[i].modulus, 1.0, 1e-4);
    EXPECT_NEAR(exact.fit.law.shear[i].time / true_series.shear[i].time, 1.0, 1e-4);
  }
  int held = 0, all = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const ViscoelasticIdentification found = identified({dma(0.02, seed)}, guess, 5);
    ASSERT_EQ(found.fit.law.shear.size(), 3u) << seed;
    EXPECT_TRUE(found.doubts.empty());
    for (std::size_t j = 0; j < found.fit.parameters.size(); ++j) {
      const std::string& name = found.fit.parameters[j].name;
      if (name != "C1" && name != "C2") continue;
      const FitEstimate& e = found.fit.result.estimates[j];
      const double truth = name == "C1" ? 8.9 : 101.6;
      held += e.lower_95 <= truth && truth <= e.upper_95 ? 1 : 0;
      ++all;
    }
  }
  EXPECT_EQ(all, 20);
  EXPECT_GE(held, 17);
}

// Steps of time at three temperatures, each with a rate of relaxation of its own.
TEST(ViscoelasticShift, OfArrheniusIsFoundFromRelaxation) {
  TemperatureShift guess = arrhenius;
  guess.activation_energy = 40e3;
  ViscoelasticExperiments tests;
  for (const double T : {283.15, 298.15, 323.15}) {
    tests.push_back(relaxation_test(at(true_series, arrhenius_factor(T)), 0.0, 1));
    tests.back().name += std::to_string(T);
    tests.back().temperatures = {T};
  }
  const ViscoelasticIdentification found = identified(tests, guess, 4);
  EXPECT_NEAR(found.fit.law.shift->activation_energy, 80e3, 8.0);
  ASSERT_EQ(found.fit.law.shear.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.fit.law.shear[i].time / true_series.shear[i].time, 1.0, 1e-4);
}

TEST(ViscoelasticShift, MovesTheWindowToTheReference) {
  ViscoelasticExperiment test = relaxation_test(true_series, 0.0, 1);
  test.temperatures = {283.15};
  const TimeWindow here = time_window({test}), there = time_window(at_reference(ViscoelasticExperiments{test}, wlf));
  EXPECT_NEAR(there.shortest * wlf_factor(283.15) / here.shortest, 1.0, 1e-9);
  EXPECT_NEAR(there.longest * wlf_factor(283.15) / here.longest, 1.0, 1e-9);
  EXPECT_EQ(n_temperatures({test, dma(0.0, 1)}), 8u);
}

}  // namespace
}  // namespace pfdm::this_file
