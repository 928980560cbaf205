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
