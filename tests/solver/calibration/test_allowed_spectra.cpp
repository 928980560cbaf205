// Ends of complex moduli over all spectra that the data allow: conditions of the extreme of a convex problem, by hand,
// and how often they hold a continuous spectrum.

#include "solver/point/allowed_spectra.h"
#include "solver/point/viscoelastic_identification.h"
#include "tests/solver/synthetic_relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace pfdm::this_file {
namespace {

constexpr double allowance = 1.96 * 1.96;

ViscoelasticIdentification few_branches(const ViscoelasticExperiments& tests, int most) {
  const PronyLaw first{.relaxed = from_young_poisson(1e6, 0.49), .shear = {{1e6, 1.0}}};
  return identify(first, tests, {.least_branches = 1, .most_branches = most});
}

double storage_at(const PronyLaw& law, double w) { return complex_modulus(shear_modulus(law), w).real(); }
ModuliFigure storage_figure(double w) {
  return [w](const LawModuli& moduli) { return complex_modulus(moduli.shear, w).real(); };
}

double sum_of(const PronyLaw& law, const ViscoelasticExperiments& tests, const std::vector<double>& deviations) {
  double sum = 0.0;
  for (const double r : fit_residuals(law, tests, deviations)) sum += r * r;
  return sum;
}

PronyLaw with_more(PronyLaw law, double time, double amount) {
  law.shear.push_back({amount, time});
  return law;
}

// Shear alone is linear in the moduli. At the extreme the sum of squares is what is allowed. What a little more modulus
// does to the sum is in proportion to what it does to the figure at every time that carries modulus, and not less at
// any other: of a convex problem no other spectrum goes further.
TEST(AllowedSpectra, EndsAreExtremesOfAConvexProblem) {
  ViscoelasticExperiment sweep = frequency_sweep(true_series, 0.02, 3);
  const ViscoelasticExperiments tests{relaxation_test(true_series, 0.01, 3), sweep};
  const ViscoelasticIdentification found = few_branches(tests, 4);
  const AllowedSpectra spectra(found.fit, tests, found.deviations);
  EXPECT_LE(spectra.least_sum(), found.fit.result.sum_of_squares + 1e-3);
  EXPECT_NEAR(sum_of(spectra.best(), tests, found.deviations), spectra.least_sum(), 0.01);
  for (const double w : {0.05, 1.0, 20.0})
    for (const double sign : {-1.0, 1.0}) {
      const auto end =
          sign < 0.0 ? spectra.lowest(storage_figure(w), allowance) : spectra.highest(storage_figure(w), allowance);
      ASSERT_TRUE(end.has_value());
      EXPECT_NEAR(end->value, storage_at(end->law, w), 1e-6 * end->value);
      const double sum = sum_of(end->law, tests, found.deviations);
      EXPECT_NEAR(sum, spectra.least_sum() + allowance, 0.02);
      const auto price = [&](double time) {
        const double amount = 1.0;  // Pa, of some MPa
        const double more = sum_of(with_more(end->law, time, amount), tests, found.deviations) - sum;
        return more / (sign * (storage_at(with_more(end->law, time, amount), w) - storage_at(end->law, w)));
      };
      double largest_modulus = 0.0, due = 0.0;
      for (const PronyBranch& b : end->law.shear)
        if (w * b.time > 0.3 && b.modulus > largest_modulus) largest_modulus = b.modulus, due = price(b.time);
      EXPECT_GT(due, 0.0);
      for (const PronyBranch& b : end->law.shear)
        if (w * b.time > 0.3) {
          EXPECT_NEAR(price(b.time), due, 0.03 * due) << w << " rad/s, " << b.time << " s";
        }
      EXPECT_NEAR(price(1e12), due, 0.03 * due) << w << " rad/s, at rest";
      for (double time = 0.3 / w; time < 600.0; time *= 1.33) {
        const double p = price(time);
        EXPECT_GT(sign * p, sign * due - 0.03 * due) << w << " rad/s, " << time << " s";
      }
    }
}

// A fractional Zener body, whose spectrum is continuous, and noise of 2 %: storage modulus inside and at both ends of
// the window.
TEST(AllowedSpectra, HoldAContinuousSpectrumWhateverTheNumberOfBranches) {
  constexpr double noise = 0.02;
  const auto body = [](double w) {
    const auto x = std::pow(std::complex(0.0, w), 0.5);
    return 1e6 + 1e9 * x / (1.0 + x);
  };
  int held = 0, all = 0;
  double widest = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    ViscoelasticExperiment sweep = frequency_sweep(true_series, noise, seed);
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal(0.0, noise);
    for (std::size_t i = 0; i < sweep.angular_frequencies.size(); ++i) {
      const auto M = body(sweep.angular_frequencies[i]);
      sweep.channels[0].values[i] = M.real() * (1.0 + normal(engine));
      sweep.channels[1].values[i] = M.imag() * (1.0 + normal(engine));
    }
    const ViscoelasticExperiments tests{sweep};
    const ViscoelasticIdentification found = few_branches(tests, 8);
    const AllowedSpectra spectra(found.fit, tests, found.deviations);
    for (const double w : {0.1, 0.5, 2.0, 10.0, 50.0, 300.0}) {
      const auto low = spectra.lowest(storage_figure(w), allowance),
                 high = spectra.highest(storage_figure(w), allowance);
      ASSERT_TRUE(low && high);
      held += low->value <= body(w).real() && body(w).real() <= high->value ? 1 : 0;
      widest = std::max(widest, 0.5 * (high->value - low->value) / body(w).real());
      ++all;
    }
  }
  EXPECT_GE(held, 0.9 * all);
  EXPECT_LE(widest, 0.05);
  RecordProperty("held_per_cent", 100 * held / all);
}

// Creep of the series in shear, 10 kPa within 0.1 s and held, with normal noise in parts of the largest strain.
ViscoelasticExperiment creep_test(double noise, unsigned seed) {
  ViscoelasticExperiment test{.name = "creep", .deformation = Deformation::shear, .follows_stress = true};
  for (int i = 0; i <= 10; ++i) test.times.push_back(0.01 * i);
  for (int i = 1; i <= 80; ++i) test.times.push_back(0.1 + 0.01 * std::pow(3e4, i / 80.0));
  for (const double t : test.times) test.followed.push_back(1e4 * std::min(t / 0.1, 1.0));
  ViscoelasticExperiment::Channel strain{.quantity = MeasuredQuantity::strain,
                                         .values = std::vector<double>(test.times.size(), 0.0)};
  test.channels = {strain};
  const std::vector<double> ones(test.times.size(), 1.0);
  const std::vector<double> strains = fit_residuals(true_series, {test}, ones);  // of values that are zero
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, noise * std::abs(strains.back()));
  for (std::size_t i = 0; i < strains.size(); ++i) test.channels[0].values[i] = std::abs(strains[i]) + normal(engine);
  test.channels[0].noise = noise * std::abs(strains.back());
  return test;
}

// Strains are not linear in the moduli, and those of a spectrum without rest have no digits left: the best one is found
// all the same, and the ends hold the truth. The bulk modulus stays: tension is hardly less known than shear.
TEST(AllowedSpectra, FindTheBestSpectrumOfCreep) {
  int found_best = 0, held = 0, all = 0;
  for (const double noise : {0.05, 0.01, 0.002})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const ViscoelasticExperiments tests{creep_test(noise, seed)};
      const ViscoelasticIdentification found = few_branches(tests, 5);
      const AllowedSpectra spectra(found.fit, tests, found.deviations);
      ++all;
      if (!spectra.is_least()) continue;
      ++found_best;
      EXPECT_NEAR(sum_of(spectra.best(), tests, found.deviations), spectra.least_sum(), 0.2);
      const double w = 0.1, due = storage_at(true_series, w);
      const auto low = spectra.lowest(storage_figure(w), 5.99), high = spectra.highest(storage_figure(w), 5.99);
      held += low && high && low->value <= due && due <= high->value ? 1 : 0;
      const auto young = [w](const LawModuli& moduli) { return complex_modulus(moduli.young, w).real(); };
      const auto least = spectra.lowest(young, 5.99), most = spectra.highest(young, 5.99);
      ASSERT_TRUE(low && high && least && most);
      const double size = complex_modulus(young_modulus(true_series), w).real();
      EXPECT_LE((most->value - least->value) / size, 2.0 * (high->value - low->value) / due + 0.01);
    }
  RecordProperty("found", found_best);
  EXPECT_GE(found_best, 0.9 * all);
  EXPECT_GE(held, 0.9 * found_best);
}

// Loss factors alone tell nothing of how large moduli are.
TEST(AllowedSpectra, SayWhatTheDataLeaveOpen) {
  ViscoelasticExperiment sweep = frequency_sweep(true_series, 0.0, 1);
  sweep.channels[1].quantity = MeasuredQuantity::loss_factor;
  for (std::size_t i = 0; i < sweep.channels[1].values.size(); ++i)
    sweep.channels[1].values[i] /= sweep.channels[0].values[i];
  sweep.channels.erase(sweep.channels.begin());
  const ViscoelasticExperiments tests{sweep};
  const std::vector<double> deviations(sweep.angular_frequencies.size(), 1e-3);
  const AllowedSpectra spectra({.law = true_series, .choice = {}, .parameters = {}, .result = {}}, tests, deviations);
  EXPECT_FALSE(spectra.highest(storage_figure(1.0), allowance).has_value());
  const auto lowest = spectra.lowest(storage_figure(1.0), allowance);
  ASSERT_TRUE(lowest.has_value());
  EXPECT_LT(lowest->value, 1e-2 * storage_at(true_series, 1.0));
}

}  // namespace
}  // namespace pfdm::this_file
