#include "physics/error.h"
#include "solver/vibration/signals/signals_filter.h"
#include "solver/vibration/signals/signals_fourier.h"
#include "solver/vibration/signals/signals_spectra.h"
#include "solver/vibration/simulation/vibration_excitation.h"
#include "tests/solver/congruential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace pfdm::this_file {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

struct Pair {
  VectorXd x = congruential(1000, 1).array() + 0.3;
  VectorXd y = VectorXd::Zero(1000);
  Pair() {
    const VectorXd e = congruential(1000, 7);
    for (Index i = 0; i < 1000; ++i) y[i] = 0.8 * x[i] + (i > 0 ? 0.5 * y[i - 1] : 0.0) + 0.2 * e[i];
  }
};

struct Reference {
  SegmentSettings settings;
  std::vector<Index> bins;
  std::vector<double> frequency, Sxx, real, imaginary, gamma2;
};

// scipy 1.10.1: welch(x, 100), csd(x, y, 100), coherence(x, y, 100) with window = 'hann', nperseg = 64, noverlap = 32
// and nperseg = 63, noverlap = 21, on the same numbers.
const Reference references[] = {
    {{64, 0.5},
     {0, 1, 5, 17, 31, 32},
     {0.0, 1.5625, 7.8125, 26.5625, 48.4375, 50.0},
     {0.00017880954829079044, 0.0012467262564331547, 0.002319476976755301, 0.002313923275133601, 0.0013255798902708064,
      0.0005579932726853795},
     {0.00029676650791448446, 0.001926313893456172, 0.0027481040847825303, 0.0015713280347073781, 0.0007537070739641722,
      0.00032937675916248563},
     {0.0, -0.0002810252468491075, -0.0012033562066562297, -0.0007487514907862045, -4.212440003035223e-05, 0.0},
     {0.8824430707880401, 0.9101323623564449, 0.9544097939133297, 0.9659681178688974, 0.9334752187634415,
      0.9298989374479583}},
    {{63, 1.0 / 3.0},
     {0, 1, 5, 17, 31},
     {0.0, 1.5873015873015872, 7.936507936507936, 26.984126984126984, 49.2063492063492},
     {0.00022576781132203845, 0.0014704534263183147, 0.0019628675407673017, 0.002223852809748316,
      0.0012961048480847246},
     {0.0002984518135357879, 0.0022177598169029027, 0.0023228353853688606, 0.0014761169867156827,
      0.0007633969148207257},
     {0.0, -0.0003523245449728475, -0.0010331684638288598, -0.0007601967279539723, -2.0026537778898024e-05},
     {0.8578431336374972, 0.9262016308470004, 0.9565463598706976, 0.9609312158311287, 0.9366725703309856}},
};

TEST(Spectra, EqualScipys) {
  const Pair p;
  for (const Reference& r : references) {
    const Spectra s = spectra(p.x, p.y, 100.0, r.settings);
    const VectorXd gamma2 = coherence(s);
    const VectorXd welch = spectral_density(p.x, 100.0, r.settings);
    for (std::size_t i = 0; i < r.bins.size(); ++i) {
      const Index k = r.bins[i];
      EXPECT_NEAR(s.frequency[k], r.frequency[i], 1e-12 * r.frequency[i]);
      EXPECT_NEAR(s.Sxx[k], r.Sxx[i], 1e-12 * r.Sxx[i]);
      EXPECT_NEAR(welch[k], r.Sxx[i], 1e-12 * r.Sxx[i]);
      const double magnitude = std::hypot(r.real[i], r.imaginary[i]);
      EXPECT_NEAR(s.Sxy[k].real(), r.real[i], 1e-12 * magnitude);
      EXPECT_NEAR(s.Sxy[k].imag(), r.imaginary[i], 1e-12 * magnitude);
      EXPECT_NEAR(gamma2[k], r.gamma2[i], 1e-12);
    }
  }
}

// scipy 1.10.1: spectrogram(x, 100, window = get_window('hann', 64), nperseg = 64, noverlap = 32).
TEST(Spectra, SpectrogramEqualsScipys) {
  const Spectrogram s = spectrogram(Pair().x, 100.0, {64, 0.5});
  ASSERT_EQ(s.time.size(), 30);
  EXPECT_NEAR(s.time[0], 0.32, 1e-14);
  EXPECT_NEAR(s.time[29], 9.6, 1e-12);
  const double expected[] = {0.0007700553690219064, 0.0016697101488818708, 0.0003073780027538736};
  const Index bins[] = {3, 9, 32};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(s.density(bins[i], 4), expected[i], 1e-12 * expected[i]);
}

// 100 s at 6000 samples/s in segments of 8192 with half overlap: the report says 146, which would need 100.352 s.
TEST(Spectra, CountsTheReportsSegments) {
  const VectorXd x = congruential(600000, 3);
  const Spectra s = spectra(x, x, 6000.0);
  EXPECT_EQ(s.segments, 145);
  EXPECT_NEAR(s.averages, 145.0 / (1.0 + 2.0 * (144.0 / 145.0) / 36.0), 1e-6);
  EXPECT_NEAR(s.frequency[1], 6000.0 / 8192.0, 1e-12);
}

TEST(Spectra, EstimatorsBracketTheResponse) {
  const Index n = 200000;
  const VectorXd x = normal_numbers(n, 1);
  const VectorXd noisy_x = x + 0.5 * normal_numbers(n, 2);
  const VectorXd noisy_y = 3.0 * x + 1.5 * normal_numbers(n, 3);
  const Spectra s = spectra(noisy_x, noisy_y, 1.0, {512, 0.5});
  const Index k = 100;
  const auto mean = [&](ResponseEstimator e) { return frequency_response(s, e).segment(20, 200).cwiseAbs().mean(); };
  EXPECT_NEAR(mean(ResponseEstimator::h1), 3.0 / 1.25, 0.03);
  EXPECT_NEAR(mean(ResponseEstimator::h2), 3.0 * 1.25, 0.03);
  EXPECT_NEAR(mean(ResponseEstimator::hv), 3.0, 0.03);
  EXPECT_NEAR(coherence(s)[k], 1.0 / (1.25 * 1.25), 0.1);
}

// The bounds hold what they say: of 2000 independent estimates 95 % lie within 1.96 deviations.
TEST(Spectra, BoundsCoverTheTruth) {
  const Index length = 64;
  const Index n = length * 33 / 2;
  int within_response = 0;
  int within_coherence = 0;
  int trials = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const VectorXd x = normal_numbers(n, 2 * seed);
    const VectorXd y = x + 0.7 * normal_numbers(n, 2 * seed + 1);
    const Spectra s = spectra(x, y, 1.0, {length, 0.5});
    const Bounds response = response_bounds(s);
    const Bounds gamma2 = coherence_bounds(s);
    for (const Index k : {5, 10, 15, 20, 25}) {
      ++trials;
      within_response += response.lower[k] <= 1.0 && 1.0 <= response.upper[k];
      within_coherence += gamma2.lower[k] <= 1.0 / 1.49 && 1.0 / 1.49 <= gamma2.upper[k];
    }
  }
  EXPECT_NEAR(static_cast<double>(within_response) / trials, 0.95, 0.025);
  EXPECT_NEAR(static_cast<double>(within_coherence) / trials, 0.95, 0.035);
}

TEST(Spectra, RefuseWhatCannotBe) {
  const VectorXd x = VectorXd::Ones(100);
  EXPECT_THROW(spectra(x, x, 1.0, {200, 0.5}), InputError);
  EXPECT_THROW(spectra(x, x, 1.0, {50, 1.0}), InputError);
  EXPECT_THROW(spectra(x, VectorXd::Ones(99), 1.0, {50, 0.5}), InputError);
}

TEST(Fourier, ComesBackAtAnyLength) {
  for (const Index n : {1, 2, 7, 64, 1001}) {
    const VectorXd x = congruential(n, 5);
    EXPECT_LT((inverse_fourier(fourier(x), n) - x).norm(), 1e-13 * std::sqrt(static_cast<double>(n))) << n;
  }
  EXPECT_EQ(fast_length(7), 8);
  EXPECT_EQ(fast_length(601), 625);
}

VectorXd wave(Index n, double rate, double frequency, double phase) {
  VectorXd x(n);
  for (Index i = 0; i < n; ++i) x[i] = std::sin(2 * pi * frequency * static_cast<double>(i) / rate + phase);
  return x;
}

TEST(Filter, IntegratesSinesExactly) {
  const double rate = 6000.0;
  const double omega = 2 * pi * 250.0;
  const VectorXd x = wave(6000, rate, 250.0, 0.4);
  const PassBand band{.low = 100.0, .high = 500.0};
  EXPECT_LT((integrated(x, rate, 1, band) + wave(6000, rate, 250.0, 0.4 + pi / 2) / omega).norm(), 1e-10 / omega);
  EXPECT_LT((integrated(x, rate, 2, band) + x / (omega * omega)).norm(), 1e-10 / (omega * omega));
  EXPECT_LT((integrated(x, rate, -1, band) - omega * wave(6000, rate, 250.0, 0.4 + pi / 2)).norm(), 1e-8 * omega);
}

TEST(Filter, HasNoPhaseAndAGentleSkirt) {
  const double rate = 6000.0;
  const PassBand band{.low = 100.0, .high = 500.0, .skirt = 0.2};
  const VectorXd kept = wave(6000, rate, 300.0, 0.1);
  const VectorXd low = wave(6000, rate, 70.0, 0.3);
  const VectorXd edge = wave(6000, rate, 550.0, 0.2);
  EXPECT_LT((filtered(kept + low, rate, band) - kept).norm(), 1e-10);
  EXPECT_LT((filtered(edge, rate, band) - 0.5 * edge).norm(), 1e-10);
}

TEST(Filter, EnvelopeIsTheAmplitude) {
  const double rate = 6000.0;
  const Index n = 12000;
  VectorXd amplitude(n);
  for (Index i = 0; i < n; ++i) amplitude[i] = 2.0 + std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(n));
  const VectorXd x = amplitude.cwiseProduct(wave(n, rate, 400.0, 0.7));
  EXPECT_LT((envelope(x) - amplitude).lpNorm<Eigen::Infinity>(), 1e-9);
}

// A sweep with a second and third harmonic whose amplitudes and phases are known at every time.
TEST(Filter, FindsTheHarmonicsOfASweep) {
  const double rate = 2000.0;
  const Index n = 40000;
  const double T = static_cast<double>(n) / rate;
  VectorXd phase(n);
  VectorXd x(n);
  for (Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / rate;
    phase[i] = 2 * pi * (20.0 * t + 0.5 * 60.0 * t * t / T);
    x[i] = 3.0 * (1.0 + t / T) * std::cos(phase[i]) + 0.5 * std::cos(2 * phase[i] + 0.4) + 0.1 * std::sin(3 * phase[i]);
  }
  const Eigen::MatrixXcd a = harmonics(x, rate, phase, 3, 4.0);
  for (Index i = n / 5; i < 4 * n / 5; i += 100) {
    const double t = static_cast<double>(i) / rate;
    EXPECT_NEAR(std::abs(a(i, 0) - 3.0 * (1.0 + t / T)), 0.0, 5e-3);
    EXPECT_NEAR(std::abs(a(i, 1) - std::polar(0.5, 0.4)), 0.0, 2e-3);
    EXPECT_NEAR(std::abs(a(i, 2) - std::complex<double>(0.0, -0.1)), 0.0, 2e-3);
  }
  const VectorXd drive = driving_phase(phase.array().cos(), rate, {.low = 10.0, .high = 100.0});
  for (Index i = n / 5; i < 4 * n / 5; i += 100) EXPECT_NEAR(std::remainder(drive[i] - phase[i], 2 * pi), 0.0, 1e-3);
}

TEST(Interpolation, IsThatOfABandLimitedSignal) {
  const double rate = 6000.0;
  const VectorXd x = wave(600, rate, 1000.0, 0.3);
  for (const double shift : {0.17, 0.5, 0.83}) {
    const VectorXd moved = shifted_samples(x, shift);
    const VectorXd expected = wave(600, rate, 1000.0, 0.3 + 2 * pi * 1000.0 * shift / rate);
    EXPECT_LT((moved - expected).segment(20, 560).lpNorm<Eigen::Infinity>(), 1e-9) << shift;
  }
}

}  // namespace
}  // namespace pfdm::this_file
