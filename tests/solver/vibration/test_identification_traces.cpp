// Tones and bursts in noise, and samples that a channel has lost.

#include "solver/vibration/diagnosis/identification_lost_samples.h"
#include "solver/vibration/identification/identification_traces.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double rate = 2500.0, low = 50.0, high = 1200.0;
constexpr Index n = 15000;

VectorXd sine(double frequency, double amplitude) {
  VectorXd x(n);
  for (Index i = 0; i < n; ++i)
    x[i] = amplitude * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / rate + 0.3);
  return x;
}

TEST(Traces, AreNotSeenInNoise) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const VectorXd noise = normal_numbers(n, seed);
    EXPECT_FALSE(tone_in(noise, rate, low, high)) << seed;
    EXPECT_FALSE(burst_in(noise, rate, low, high)) << seed;
    // Noise of a resonance: each value is 0.98 of the last but one less, and new.
    VectorXd coloured = noise;
    for (Index i = 2; i < n; ++i) coloured[i] += 1.6 * coloured[i - 1] - 0.96 * coloured[i - 2];
    EXPECT_FALSE(tone_in(coloured, rate, low, high)) << seed;
    EXPECT_FALSE(burst_in(coloured, rate, low, high)) << seed;
  }
}

// A tone of amplitude a has the power a^2/2 beside that of the noise within the band.
TEST(Traces, TonesAreFoundWhereTheyAre) {
  for (const double frequency : {150.0, 333.3, 1021.7}) {
    const auto tone = tone_in(normal_numbers(n, 3) + sine(frequency, 0.6), rate, low, high);
    ASSERT_TRUE(tone);
    EXPECT_NEAR(tone->frequency, frequency, rate / static_cast<double>(n));
    const double noise = (high - low) / (0.5 * rate);
    EXPECT_NEAR(tone->part, 0.18 / (0.18 + noise), 0.02);
  }
}

TEST(Traces, BurstsAreFoundWhereTheyAre) {
  VectorXd x = normal_numbers(n, 4);
  x.segment(8000, 40) += 6.0 * sine(300.0, 1.0).head(40);
  const auto burst = burst_in(x, rate, low, high);
  ASSERT_TRUE(burst);
  EXPECT_NEAR(burst->time, 8020.0 / rate, 0.03);
  EXPECT_LE(burst->number, 2);
  EXPECT_FALSE(tone_in(x, rate, low, high));
}

/// Base and relative acceleration of a mass at 80 Hz with a damping of 10 %, by the exact response to each sine.
VibrationRecord record_of_a_mass() {
  VibrationRecord r{.name = "sines", .rate = 1000.0, .base = {}, .relative = {}, .band_low = 20.0, .band_high = 150.0};
  r.base = VectorXd::Zero(12000);
  r.relative = VectorXd::Zero(12000);
  for (int k = 0; k < 130; ++k) {
    const double omega = 2.0 * std::numbers::pi * (20.4 + k + 0.3 * std::sin(7.0 * k)),
                 f0 = 2.0 * std::numbers::pi * 80.0;
    const std::complex<double> H =
        omega * omega / (f0 * f0 - omega * omega + std::complex<double>(0.0, 0.2 * f0 * omega));
    for (Index i = 0; i < r.n(); ++i) {
      const auto turn = std::polar(1.0, omega * static_cast<double>(i) / r.rate + 1.7 * k * k);
      r.base[i] += turn.real();
      r.relative[i] += (H * turn).real();
    }
  }
  return r;
}

TEST(LostSamples, AreCountedAndPlaced) {
  const VibrationRecord whole = record_of_a_mass();
  EXPECT_FALSE(lost_samples(whole, 1));
  for (const int number : {9, -9, 30}) {
    VibrationRecord r = whole;
    VectorXd& lossy = number > 0 ? r.relative : r.base;
    const Index at = 5000, gone = std::abs(number), left = whole.n() - gone;
    lossy.segment(at, left - at) = lossy.tail(left - at).eval();
    r.base.conservativeResize(left);
    r.relative.conservativeResize(left);
    const auto lost = lost_samples(r, 1);
    ASSERT_TRUE(lost) << number;
    EXPECT_EQ(lost->number, number);
    EXPECT_NEAR(lost->time, 5.0, 0.31);
    EXPECT_LT(lost->unexplained, std::sqrt(2.0 / 40.0));  // one of 40 windows out of step
    EXPECT_FALSE(lost_samples(lost->longer, 1));
  }
}

}  // namespace
}  // namespace pfdm::this_file
