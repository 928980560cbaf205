// Records without a model. The reference values are those of a discrete Fourier transform written out as sums in
// Python, whose density at bin 5 is SciPy's of test_signals.cpp.

#include "physics/error.h"
#include "solver/vibration/diagnosis/record_analysis.h"
#include "solver/vibration/simulation/vibration_excitation.h"
#include "tests/solver/congruential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VibrationRecord random_record() {
  VibrationRecord r{.name = "random", .rate = 100.0, .base = {}, .relative = {}, .band_low = 5.0, .band_high = 40.0};
  r.base = congruential(1000, 1).array() + 0.3;
  r.relative = VectorXd::Zero(1000);
  const VectorXd e = congruential(1000, 7);
  for (Index i = 0; i < 1000; ++i)
    r.relative[i] = 0.8 * r.base[i] + (i > 0 ? 0.5 * r.relative[i - 1] : 0.0) + 0.2 * e[i];
  return r;
}

TEST(RecordAnalysis, EqualsSumsWrittenOut) {
  const RecordAnalysis a = analysed(random_record(), {.segments = {64, 0.5}, .spectrogram_length = 64});
  EXPECT_FALSE(a.tracked);
  EXPECT_EQ(a.spectra.segments, 30);
  struct Row {
    Index bin;
    double H1, phase, H2, Hv, coherence;
  };
  const Row rows[] = {
      {5, 1.2934052518968389, -0.41273435244407297, 1.3551885784758548, 1.3239365637035945, 0.9544097939133299},
      {17, 0.7522304352837043, -0.4446785863246436, 0.7787321562364427, 0.7653665976871193, 0.9659681178688968},
      {25, 0.5667739720646227, -0.2760083051658844, 0.6119719638772471, 0.5889395391369942, 0.9261436887953735}};
  for (const Row& row : rows) {
    EXPECT_NEAR(std::abs(a.H1[row.bin]), row.H1, 1e-10);
    EXPECT_NEAR(std::abs(a.H2[row.bin]), row.H2, 1e-10);
    EXPECT_NEAR(std::abs(a.Hv[row.bin]), row.Hv, 1e-10);
    for (const auto& H : {a.H1, a.H2, a.Hv}) EXPECT_NEAR(std::arg(H[row.bin]), row.phase, 1e-10);
    EXPECT_NEAR(a.coherence[row.bin], row.coherence, 1e-10);
    EXPECT_LT(a.coherence_bounds.lower[row.bin], row.coherence);
    EXPECT_GT(a.coherence_bounds.upper[row.bin], row.coherence);
  }
  EXPECT_NEAR(a.level.base_density, 0.0016205317944311794, 1e-12);
  EXPECT_NEAR(a.level.rms_base, 0.42069574094977974, 1e-12);
  EXPECT_NEAR(a.level.peak_relative, 1.2389086474026654, 1e-12);
  EXPECT_NEAR(a.spectrogram.density(9, 4), 0.0011834223068272363, 1e-12);
  EXPECT_NEAR(a.spectrogram.time[4], 1.6, 1e-12);
}

// Bounds of 95 %: of independent records the coherence and |H1| of the system lie within them in about 95 of 100.
TEST(RecordAnalysis, BoundsHoldTheTruth) {
  constexpr int trials = 40;
  int held_H = 0, held_coherence = 0, n = 0;
  for (int trial = 0; trial < trials; ++trial) {
    VibrationRecord r{.name = "r", .rate = 100.0, .base = {}, .relative = {}, .band_low = 5.0, .band_high = 40.0};
    r.base = normal_numbers(8000, 2 * static_cast<std::uint64_t>(trial) + 1);
    r.relative = 2.0 * r.base + normal_numbers(8000, 2 * static_cast<std::uint64_t>(trial) + 2);
    const RecordAnalysis a = analysed(r, {.segments = {128, 0.5}});
    for (Index k = 8; k < 56; k += 4, ++n) {  // far enough apart to be independent
      held_H += a.H1_bounds.lower[k] <= 2.0 && 2.0 <= a.H1_bounds.upper[k];
      held_coherence += a.coherence_bounds.lower[k] <= 0.8 && 0.8 <= a.coherence_bounds.upper[k];  // 4/(4 + 1)
    }
  }
  EXPECT_NEAR(static_cast<double>(held_H) / n, 0.95, 0.035);
  EXPECT_NEAR(static_cast<double>(held_coherence) / n, 0.95, 0.035);
}

TEST(RecordAnalysis, ChoosesSegmentsThatFollowASweep) {
  VibrationRecord r{.name = "r", .rate = 6000.0, .base = {}, .relative = {}, .band_low = 100.0, .band_high = 420.0};
  r.base = VectorXd::Zero(360000);
  // 5.33 Hz/s: in 0.433 s, 2598 samples, the frequency moves by the resolution of such a segment.
  EXPECT_EQ(spectrogram_segments(r, true), 2048);
  EXPECT_EQ(spectrogram_segments(r, false), 4096);
  r.base = VectorXd::Zero(200);
  EXPECT_EQ(spectrogram_segments(r, false), 200);
}

TEST(RecordAnalysis, CutsSegmentsToTheRecordAndRefusesOthers) {
  const VibrationRecord r = random_record();
  EXPECT_EQ(analysed(r, {}).segments.length, 1000);
  EXPECT_THROW(analysed(r, {.segments = {64, 1.0}}), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
