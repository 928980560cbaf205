// Prony branches estimated from tests of a known series.

#include "solver/point/viscoelastic_identification.h"
#include "tests/solver/synthetic_relaxation.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace pfdm::this_file {
namespace {

const PronyLaw first_guess{.relaxed = from_young_poisson(1e6, 0.49), .shear = {{1e6, 1.0}}};

ViscoelasticIdentification identified(const std::vector<ViscoelasticExperiment>& tests, int least, int most,
                                      BranchTimes times = BranchTimes::free) {
  ViscoelasticSettings settings{.least_branches = least, .most_branches = most};
  settings.choice.times = times == BranchTimes::free;
  return identify(first_guess, tests, settings);
}

void expect_series(const PronyLaw& found, const PronyLaw& due, double tolerance) {
  EXPECT_NEAR(found.relaxed.young_modulus(), due.relaxed.young_modulus(), tolerance * due.relaxed.young_modulus());
  ASSERT_EQ(found.shear.size(), due.shear.size());
  for (std::size_t i = 0; i < due.shear.size(); ++i) {
    EXPECT_NEAR(found.shear[i].modulus, due.shear[i].modulus, tolerance * due.shear[i].modulus) << i;
    EXPECT_NEAR(found.shear[i].time, due.shear[i].time, tolerance * due.shear[i].time) << i;
  }
}

TEST(ViscoelasticFit, WithoutNoiseFindsTheSeriesAndHowManyBranches) {
  ViscoelasticExperiment relaxation = relaxation_test(true_series, 0.0, 1);
  ViscoelasticExperiment sweep = frequency_sweep(true_series, 0.0, 1);
  for (const auto& tests :
       std::vector<std::vector<ViscoelasticExperiment>>{{relaxation}, {sweep}, {relaxation, sweep}}) {
    const ViscoelasticIdentification found = identified(tests, 1, 5);
    EXPECT_EQ(found.tried.size(), 5u);
    expect_series(found.fit.law, true_series, 1e-5);
  }
}

TEST(ViscoelasticFit, CreepAndLossFactorsGiveTheSameSeries) {
  // A stress that rises within 0.05 s and is held; the strains by the retardations of the known series.
  ViscoelasticExperiment creep = relaxation_test(true_series, 0.0, 1);
  creep.deformation = Deformation::tension;
  creep.follows_stress = true;
  for (double& value : creep.followed) value *= 1e6;
  creep.channels[0].quantity = MeasuredQuantity::strain;
  creep.channels[0].values = strain_response(creep_compliance(young_modulus(true_series)), creep.times, creep.followed);
  expect_series(identified({creep}, 1, 4).fit.law, true_series, 1e-5);
  ViscoelasticExperiment sweep = frequency_sweep(true_series, 0.0, 1);
  sweep.channels[1].quantity = MeasuredQuantity::loss_factor;
  for (std::size_t i = 0; i < sweep.channels[1].values.size(); ++i)
    sweep.channels[1].values[i] /= sweep.channels[0].values[i];
  expect_series(identified({sweep}, 1, 4).fit.law, true_series, 1e-5);
  ViscoelasticExperiment loss_factor_alone = sweep;
  loss_factor_alone.channels.erase(loss_factor_alone.channels.begin());
  expect_series(identified({creep, loss_factor_alone}, 1, 4).fit.law, true_series, 1e-5);
}

/// A test whose ramp took 0.05 s and whose first row is the end of the ramp.
TEST(ViscoelasticFit, ARampBeforeTheFirstRowIsNoStep) {
  ViscoelasticExperiment test = relaxation_test(true_series, 0.0, 1);
  test.times.erase(test.times.begin(), test.times.begin() + 10);
  test.followed.erase(test.followed.begin(), test.followed.begin() + 10);
  test.channels[0].values.erase(test.channels[0].values.begin(), test.channels[0].values.begin() + 10);
  for (double& t : test.times) t -= 0.05;
  test.ramp = 0.05;
  expect_series(identified({test}, 1, 4).fit.law, true_series, 1e-5);
  test.ramp = 0.0;
  // As a step it has the same times and too small a modulus: (1 - exp(-1)) of a branch as fast as the ramp.
  EXPECT_NEAR(identified({test}, 3, 3).fit.law.shear[0].modulus, -std::expm1(-1.0) * true_series.shear[0].modulus,
              1e-4 * true_series.shear[0].modulus);
}

TEST(ViscoelasticFit, TensionAndShearGivePoissonsRatio) {
  ViscoelasticExperiment tension = relaxation_test(true_series, 0.0, 1);
  tension.deformation = Deformation::tension;
  const PronyLaw compressible{.relaxed = from_young_poisson(3e6, 0.4), .shear = true_series.shear};
  tension.channels[0].values = stress_response(young_modulus(compressible), tension.times, tension.followed);
  ViscoelasticSettings settings{.least_branches = 3, .most_branches = 3};
  settings.choice.poisson_ratio = true;
  const auto found = identify(first_guess, {tension, relaxation_test(compressible, 0.0, 1)}, settings);
  expect_series(found.fit.law, compressible, 1e-5);
  EXPECT_NEAR(found.fit.law.relaxed.poisson_ratio(), 0.4, 1e-5);
}

TEST(ViscoelasticFit, ABranchBeyondTheTestsIsSaid) {
  // 20 s of relaxation do not show a branch of 60 s; what is fitted in its place lies at the end, or is not told apart.
  const auto found = identified({relaxation_test(true_series, 1e-4, 1, 20.0)}, 1, 4);
  const auto whole = identified({relaxation_test(true_series, 1e-4, 1)}, 1, 4);
  EXPECT_TRUE(whole.doubts.empty()) << whole.doubts.front();
  ASSERT_FALSE(found.doubts.empty());
  EXPECT_NE(found.doubts.front().find("outside"), std::string::npos) << found.doubts.front();
}

TEST(ViscoelasticFit, FixedTimesKeepPositiveModuli) {
  const std::vector<ViscoelasticExperiment> tests{relaxation_test(true_series, 0.005, 3),
                                                  frequency_sweep(true_series, 0.01, 3)};
  const auto found = identified(tests, 4, 12, BranchTimes::fixed);
  ASSERT_FALSE(found.fit.law.shear.empty());
  for (const PronyBranch& branch : found.fit.law.shear) EXPECT_GT(branch.modulus, 0.0);
  // The curve is met, whatever the branches are.
  for (const double w : {0.1, 1.0, 10.0, 300.0}) {
    const auto M = complex_modulus(shear_modulus(found.fit.law), w),
               due = complex_modulus(shear_modulus(true_series), w);
    EXPECT_LE(std::abs(M - due), 0.02 * std::abs(due)) << w << " rad/s";
  }
}

TEST(ViscoelasticFit, TimesOfTheMaterialStayWhereTheyAreFixed) {
  PronyLaw first = true_series;
  for (PronyBranch& branch : first.shear) branch.modulus = 1e5;
  first.relaxed = from_young_poisson(1e6, 0.49);
  ViscoelasticSettings settings;
  settings.choice.times = false;
  const auto found = identify(first, {relaxation_test(true_series, 0.0, 1)}, settings);
  EXPECT_EQ(found.fit.parameters.size(), 4u);
  expect_series(found.fit.law, true_series, 1e-8);
}

// A fractional Zener body, G = G_inf + (G_0 - G_inf) (i w tau)^a/(1 + (i w tau)^a), has a continuous spectrum: as many
// branches as its noise shows meet the curve.
TEST(ViscoelasticFit, AContinuousSpectrumIsMetWithinItsNoise) {
  constexpr double noise = 0.02;
  const auto body = [](double w) {
    const auto x = std::pow(std::complex(0.0, w), 0.5);
    return 1e6 + 1e9 * x / (1.0 + x);
  };
  ViscoelasticExperiment sweep = frequency_sweep(true_series, noise, 5);
  std::mt19937 engine(5);
  std::normal_distribution<double> normal(0.0, noise);
  for (std::size_t i = 0; i < sweep.angular_frequencies.size(); ++i) {
    sweep.channels[0].values[i] = body(sweep.angular_frequencies[i]).real() * (1.0 + normal(engine));
    sweep.channels[1].values[i] = body(sweep.angular_frequencies[i]).imag() * (1.0 + normal(engine));
  }
  const auto found = identified({sweep}, 1, 10);
  EXPECT_LT(found.fit.result.rms, 1.1);
  EXPECT_GE(found.fit.law.shear.size(), 4u);
  const RelaxationModulus G = shear_modulus(found.fit.law);
  for (const double w : sweep.angular_frequencies)
    EXPECT_LE(std::abs(complex_modulus(G, w) - body(w)), 0.03 * std::abs(body(w))) << w << " rad/s";
}

// Noise of 1 % of the largest stress and of 2 % of each modulus: estimates without bias, and intervals that hold the
// truth as often as they say. 100 repetitions by the whole program: tests/statistics/prony_coverage.py.
TEST(ViscoelasticFit, IntervalsOfTwentyRepetitionsHoldTheTruth) {
  constexpr int n = 20;
  int held = 0, all = 0, three = 0;
  std::map<std::string, double> sum;
  const ViscoelasticChoice choice;
  for (unsigned seed = 1; seed <= n; ++seed) {
    const auto found =
        identified({relaxation_test(true_series, 0.01, seed), frequency_sweep(true_series, 0.02, seed)}, 2, 4);
    three += found.fit.law.shear.size() == 3 ? 1 : 0;
    if (found.fit.law.shear.size() != 3) continue;
    const std::vector<FitParameter> truth = fit_parameters(true_series, choice, {});
    for (std::size_t j = 0; j < truth.size(); ++j) {
      const FitEstimate& e = found.fit.result.estimates[j];
      EXPECT_EQ(found.fit.parameters[j].name, truth[j].name);
      held += e.lower_95 <= truth[j].first && truth[j].first <= e.upper_95 ? 1 : 0;
      ++all;
      sum[truth[j].name] += (e.value - truth[j].first) / e.standard_error;
    }
  }
  EXPECT_EQ(three, n);
  EXPECT_GE(held, 0.9 * all);
  EXPECT_LE(held, 0.995 * all);
  for (const auto& [name, total] : sum) EXPECT_LE(std::abs(total / n), 0.7) << name;  // 3.1 standard errors of the mean
}

// A branch of nothing keeps bounds with room between them.
TEST(ViscoelasticFit, BoundsOfBranchesOfNothingAreBounds) {
  const PronyLaw law{.relaxed = from_young_poisson(1e6, 0.49), .shear = {{1e-12, 1.0}}};
  for (const FitParameter& p : fit_parameters(law, {}, {.shortest = 0.1, .longest = 10.0})) {
    EXPECT_LT(p.lower, p.upper) << p.name;
    EXPECT_LE(p.lower, p.first) << p.name;
    EXPECT_LE(p.first, p.upper) << p.name;
  }
}

// Rest before the load, and rows close to each other while it stays, show no relaxation.
TEST(ViscoelasticFit, TheWindowIsThatOfTheLoad) {
  ViscoelasticExperiment test = relaxation_test(true_series, 0.0, 1, 20.0);
  const TimeWindow window = time_window({test});
  EXPECT_DOUBLE_EQ(window.shortest, 0.005);
  EXPECT_DOUBLE_EQ(window.longest, 20.0);
  for (double& t : test.times) t += 600.0;
  test.times.insert(test.times.begin(), 0.0);
  test.times.push_back(test.times.back() + 1e-9);
  test.followed.insert(test.followed.begin(), 0.0);
  test.followed.push_back(test.followed.back());
  const TimeWindow with_rest = time_window({test});
  EXPECT_NEAR(with_rest.shortest, 0.005, 1e-12);
  EXPECT_NEAR(with_rest.longest, 20.0, 1e-6);
}

}  // namespace
}  // namespace pfdm::this_file
