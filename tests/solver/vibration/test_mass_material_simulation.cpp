#include "solver/vibration/signals/lanes.h"
#include "solver/vibration/signals/signals_spectra.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;
constexpr double g0 = 9.80665;

MassMaterial linear_with_kernel() {
  return {.mass = 1.12,
          .stiffness = {2.0e6},
          .damping = 35.0,
          .forcing = KernelForcing::velocity,
          .kernel = {{400.0, 3.3e5}, {Complex(900.0, 1200.0), Complex(2e5, 5e4)}}};
}

MassMaterial nonlinear(KernelForcing forcing, double lambda) {
  MassMaterial m{.mass = 1.12,
                 .stiffness = {2.0e6, -5e8, -2e12, 2e15, 1e19},
                 .damping = 140.0,
                 .damping_exponent = lambda,
                 .reference_velocity = 0.3,
                 .forcing = forcing,
                 .kernel = {}};
  const double beta = forcing == KernelForcing::displacement ? -1e8
                      : forcing == KernelForcing::stiffness  ? -150.0
                                                             : 2e5;
  if (forcing != KernelForcing::none) m.kernel.push_back({1500.0, beta});
  return m;
}

// z = Re[Z exp(j omega t)] with Z = -Y/(K - m omega^2) once the start has died away.
TEST(Simulation, ReachesTheSteadyStateOfALinearModel) {
  const MassMaterial m = linear_with_kernel();
  const double f = 180.0;
  const double omega = 2 * pi * f;
  const Complex gain = m.mass * omega * omega / (complex_stiffness(m, omega) - m.mass * omega * omega);
  const Excitation shaker = harmonic(5 * g0, f, 2.0, 0.0);
  const Motion motion = simulate(m, shaker, 6000.0);
  const BaseNodes nodes = nodes_of(shaker, 6000.0, substeps_for(m, 6000.0));
  const VectorXd batch = simulate_batch(std::vector{m}, nodes).col(0);
  for (Index i = 9000; i < 12000; i += 7) {
    const double t = static_cast<double>(i) / 6000.0;
    const double expected = 5 * g0 * (gain * Complex(std::sin(omega * t), -std::cos(omega * t))).real();
    EXPECT_NEAR(motion.acceleration[i], expected, 1e-7 * 5 * g0 * std::abs(gain));
    EXPECT_NEAR(batch[i], expected, 1e-6 * 5 * g0 * std::abs(gain));
  }
}

// Two integrations that have nothing in common but the terms' formulas.
TEST(Simulation, TheTwoWaysAgreeForEveryForcing) {
  const Excitation shaker = swept_sine({.amplitude = 5 * g0, .from = 150, .to = 350, .duration = 1.5, .ramp = 0.1});
  for (const double lambda : {0.0, 1.8})
    for (const auto forcing : {KernelForcing::none, KernelForcing::displacement, KernelForcing::velocity,
                               KernelForcing::stiffness, KernelForcing::damping}) {
      SCOPED_TRACE(static_cast<int>(forcing));
      const MassMaterial m = nonlinear(forcing, lambda);
      const Motion motion = simulate(m, shaker, 6000.0);
      ASSERT_TRUE(motion.bounded);
      const VectorXd batch =
          simulate_batch(std::vector{m, m, m, m, m}, nodes_of(shaker, 6000.0, substeps_for(m, 6000.0))).col(4);
      // |z'|^1.8 z' is not smooth where z' = 0; there a fixed step sees a kink.
      EXPECT_LT((batch - motion.acceleration).norm(), (lambda == 0.0 ? 1e-7 : 1e-5) * motion.acceleration.norm());
    }
}

TEST(Lanes, PowerIsThatOfTheLibrary) {
  for (const double e : {0.0, 0.3, 1.0, 1.8, 4.0})
    for (double x = 1e-8; x < 1e3; x *= 1.37) {
      const Lanes found = power(absolute(Lanes::all(-x)), Lanes::all(e));
      EXPECT_NEAR(found[0], std::pow(x, e), 2e-14 * std::pow(x, e)) << x << " to the " << e;
      EXPECT_EQ(found[7], found[0]);
    }
  const Lanes zero = power(Lanes::all(0.0), Lanes::all(1.8));
  EXPECT_GE(zero[3], 0.0);
  EXPECT_LT(zero[3], 1e-200);
}

// Side by side with others, of other lengths and rates, a run is what it is alone.
TEST(Simulation, RunsOfAGroupDoNotMix) {
  const MassMaterial m = nonlinear(KernelForcing::damping, 1.8);
  MassMaterial other = m;
  other.damping *= 1.5;
  const SweptSine sweep{.amplitude = 5 * g0, .from = 150, .to = 350, .duration = 0.4, .ramp = 0.1};
  SweptSine shorter = sweep;
  shorter.duration = 0.25;
  const BaseNodes bases[] = {nodes_of(swept_sine(sweep), 6000.0, 1), nodes_of(swept_sine(shorter), 4500.0, 1)};
  const SimulationRun runs[] = {{&m, &bases[0]}, {&m, &bases[1]}, {&other, &bases[1]}};
  ASSERT_EQ(simulation_groups(runs).size(), 1u);
  const auto together = simulate_group(runs);
  for (std::size_t i = 0; i < 3; ++i) {
    const VectorXd alone = simulate_group(std::span(&runs[i], 1)).front();
    ASSERT_EQ(together[i].size(), runs[i].base->n_samples());
    EXPECT_EQ((together[i] - alone).norm(), 0.0) << i;
  }
  EXPECT_GT((together[2] - together[1]).norm(), 1e-3 * together[1].norm());
}

TEST(Simulation, FixedStepsConvergeWithOrderEight) {
  const MassMaterial m = nonlinear(KernelForcing::velocity, 0.0);
  const Excitation shaker = swept_sine({.amplitude = 5 * g0, .from = 150, .to = 350, .duration = 0.5, .ramp = 0.1});
  const auto error = [&](double rate, Index stride) {
    const VectorXd fine = simulate_batch(std::vector{m}, nodes_of(shaker, 24000.0, 1)).col(0);
    const VectorXd coarse = simulate_batch(std::vector{m}, nodes_of(shaker, rate, 1)).col(0);
    double worst = 0.0;
    for (Index i = 0; i < coarse.size(); ++i) worst = std::max(worst, std::abs(coarse[i] - fine[stride * i]));
    return worst;
  };
  const double order = std::log2(error(1500.0, 16) / error(3000.0, 8));
  EXPECT_GT(order, 7.3);
  EXPECT_LT(order, 9.5);
}

TEST(Simulation, TellsWhenTheMassRunsAway) {
  MassMaterial m = nonlinear(KernelForcing::none, 0.0);
  m.stiffness = {2e6, 0.0, -2e14};
  const Excitation shaker = harmonic(50 * g0, 210, 0.5, 0.0);
  EXPECT_FALSE(simulate(m, shaker, 6000.0).bounded);
  const MassMaterial stable = nonlinear(KernelForcing::none, 0.0);
  MassMaterial same_terms = stable;
  same_terms.stiffness = {2e6, 0.0, -2e14, 0.0, 0.0};
  const Eigen::MatrixXd both = simulate_batch(std::vector{stable, same_terms}, nodes_of(shaker, 6000.0, 1));
  EXPECT_TRUE(both.col(0).allFinite());
  EXPECT_FALSE(both.col(1).allFinite());
}

TEST(Excitation, SweepsPassTheirFrequencies) {
  for (const bool logarithmic : {false, true})
    for (const auto& [from, to] : {std::pair(8.0, 68.0), std::pair(68.0, 8.0)}) {
      const Excitation e =
          swept_sine({.amplitude = 2.0, .from = from, .to = to, .duration = 60.0, .logarithmic = logarithmic});
      EXPECT_NEAR(e.frequency(0.0), from, 1e-12);
      EXPECT_NEAR(e.frequency(60.0), to, 1e-9);
      // The frequency is the slope of the phase: count zero crossings over a second.
      int crossings = 0;
      for (double t = 30.0; t < 31.0; t += 1e-4) crossings += (e.acceleration(t) < 0) != (e.acceleration(t + 1e-4) < 0);
      EXPECT_NEAR(0.5 * crossings, e.frequency(30.5), 1.0);
      EXPECT_EQ(e.band_low, 8.0);
    }
  const Excitation ramped = swept_sine({.amplitude = 2.0, .from = 8, .to = 68, .duration = 60.0, .ramp = 1.0});
  EXPECT_EQ(ramped.acceleration(0.0), 0.0);
  EXPECT_LT(std::abs(ramped.acceleration(59.999)), 1e-4);
}

TEST(Excitation, RandomHasItsDensityAndItsSeed) {
  const double density = 0.05 * g0 * g0;
  const BandLimitedRandom random{.density = density, .low = 10, .high = 1000, .duration = 40, .seed = 3};
  const Excitation e = band_limited_random(random);
  VectorXd x(240000);
  for (Index i = 0; i < x.size(); ++i) x[i] = e.acceleration(static_cast<double>(i) / 6000.0);
  const VectorXd S = spectral_density(x, 6000.0, {4096, 0.5});
  const double df = 6000.0 / 4096;
  const auto mean = [&](double low, double high) {
    const auto first = static_cast<Index>(low / df);
    return S.segment(first, static_cast<Index>(high / df) - first).mean();
  };
  EXPECT_NEAR(mean(20, 980), density, 0.02 * density);
  EXPECT_LT(mean(1010, 2900), 1e-6 * density);
  EXPECT_EQ(band_limited_random(random).acceleration(1.2345), e.acceleration(1.2345));
  BandLimitedRandom other = random;
  other.seed = 4;
  EXPECT_NE(band_limited_random(other).acceleration(1.2345), e.acceleration(1.2345));
}

TEST(Excitation, SamplesBecomeTheSignalThroughThem) {
  const Excitation e = band_limited_random({.density = 1.0, .low = 10, .high = 1000, .duration = 2, .seed = 9});
  VectorXd x(12001);
  for (Index i = 0; i < x.size(); ++i) x[i] = e.acceleration(static_cast<double>(i) / 6000.0);
  const Excitation again = sampled_excitation(x, 6000.0, 10, 1000);
  const BaseNodes exact = nodes_of(e, 6000.0, 2);
  const BaseNodes nodes = nodes_of(x, 6000.0, 2);
  ASSERT_EQ(exact.values.size(), nodes.values.size());
  const Index margin = 8 * 20;
  const Index n = nodes.values.size() - 2 * margin;
  EXPECT_LT((exact.values - nodes.values).segment(margin, n).lpNorm<Eigen::Infinity>(), 1e-6);
  for (double t = 0.1; t < 1.9; t += 0.01234567) EXPECT_NEAR(again.acceleration(t), e.acceleration(t), 1e-6);
}

TEST(Noise, HasItsLevel) {
  VibrationRecord record;
  record.rate = 6000;
  record.base = VectorXd::Constant(100000, 2.0);
  record.relative = VectorXd::Constant(100000, 5.0);
  add_noise(record, 40.0, 1);
  EXPECT_NEAR((record.base.array() - 2.0).matrix().norm() / std::sqrt(1e5), 0.02, 2e-4);
  EXPECT_NEAR((record.relative.array() - 5.0).matrix().norm() / std::sqrt(1e5), 0.05, 5e-4);
}

}  // namespace
}  // namespace pfdm::this_file
