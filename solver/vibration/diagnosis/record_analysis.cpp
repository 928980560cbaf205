#include "solver/vibration/diagnosis/record_analysis.h"

#include "solver/calibration/calibration_statistics.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/signals/signals_filter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfdm {
namespace {
using Eigen::VectorXd;

TestLevel level_of(const VibrationRecord& r, const Spectra& s) {
  TestLevel level{.rms_base = rms(r.base),
                  .rms_relative = rms(r.relative),
                  .peak_base = r.base.lpNorm<Eigen::Infinity>(),
                  .peak_relative = r.relative.lpNorm<Eigen::Infinity>()};
  double n = 0.0;
  for (Eigen::Index i = 0; i < s.frequency.size(); ++i) {
    if (s.frequency[i] < r.band_low || s.frequency[i] > r.band_high) continue;
    level.base_density += s.Sxx[i];
    n += 1.0;
  }
  level.base_density /= std::max(n, 1.0);
  return level;
}

SegmentSettings fitting(SegmentSettings segments, Eigen::Index n) {
  segments.length = std::min(segments.length, n);
  return segments;
}

/// Of a phase in samples: its slope over +-half, exact where the frequency moves linearly.
VectorXd frequency_of(const VectorXd& phase, double rate, Eigen::Index half) {
  const Eigen::Index n = phase.size();
  VectorXd f(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index reach = std::max<Eigen::Index>(1, std::min({half, i, n - 1 - i}));
    const Eigen::Index from = std::max<Eigen::Index>(0, i - reach), to = std::min<Eigen::Index>(n - 1, i + reach);
    f[i] = (phase[to] - phase[from]) * rate / (2.0 * std::numbers::pi * static_cast<double>(to - from));
  }
  return f;
}

}  // namespace

double TrackedResponse::median_base() const { return quantile({base.begin(), base.end()}, 0.5); }

Eigen::Index TrackedResponse::at_resonance() const {
  const double least = 0.5 * median_base();  // beside the ramps
  Eigen::Index best = 0;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < base.size(); ++i)
    if (base[i] > least && harmonics(i, 0) / base[i] > largest) {
      largest = harmonics(i, 0) / base[i];
      best = i;
    }
  return best;
}

double tracker_bandwidth(const VibrationRecord& record) { return std::min(4.0, 0.4 * record.band_low); }

Eigen::Index tracker_stride(double rate) { return std::max<Eigen::Index>(1, static_cast<Eigen::Index>(rate / 40.0)); }

Eigen::Index spectrogram_segments(const VibrationRecord& r, bool swept) {
  double length = static_cast<double>(r.n()) / 16.0;
  if (swept && r.band_high > r.band_low) length = r.rate * std::sqrt(r.duration() / (r.band_high - r.band_low));
  const auto power = std::bit_floor(static_cast<unsigned>(std::max(length, 1.0)));
  return std::min<Eigen::Index>(std::clamp<Eigen::Index>(power, 256, swept ? 16384 : 4096), r.n());
}

TrackedResponse tracked_response(const VibrationRecord& r, int n_harmonics, double bandwidth) {
  const PassBand band{.low = 0.8 * r.band_low, .high = 1.2 * r.band_high};
  const VectorXd phase = driving_phase(r.base, r.rate, band);
  const VectorXd f = frequency_of(phase, r.rate, static_cast<Eigen::Index>(0.5 * r.rate / bandwidth));
  const Eigen::MatrixXd relative = harmonics(r.relative, r.rate, phase, n_harmonics, bandwidth).cwiseAbs();
  const VectorXd base = harmonics(r.base, r.rate, phase, 1, bandwidth).cwiseAbs();
  const VectorXd hull = envelope(r.relative);
  const Eigen::Index stride = tracker_stride(r.rate), n = (r.n() - 1) / stride + 1;
  const auto kept = Eigen::seqN(Eigen::Index{0}, n, stride);
  return {.time = VectorXd::LinSpaced(n, 0.0, static_cast<double>((n - 1) * stride)) / r.rate,
          .frequency = f(kept),
          .base = base(kept),
          .harmonics = relative(kept, Eigen::all),
          .envelope = hull(kept),
          .bandwidth = bandwidth};
}

RecordAnalysis analysed(const VibrationRecord& record, const AnalysisSettings& settings) {
  const bool swept = driving_base(record).swept;
  RecordAnalysis a;
  a.segments = fitting(settings.segments, record.n());
  a.spectra = spectra(record.base, record.relative, record.rate, a.segments);
  a.level = level_of(record, a.spectra);
  a.H1 = frequency_response(a.spectra, ResponseEstimator::h1);
  a.H2 = frequency_response(a.spectra, ResponseEstimator::h2);
  a.Hv = frequency_response(a.spectra, ResponseEstimator::hv);
  a.H1_bounds = response_bounds(a.spectra);
  a.phase_deviation = relative_response_deviation(a.spectra);
  a.coherence = coherence(a.spectra);
  a.coherence_bounds = coherence_bounds(a.spectra);
  SegmentSettings short_ones = settings.segments;
  short_ones.length = settings.spectrogram_length.value_or(spectrogram_segments(record, swept));
  a.spectrogram = spectrogram(record.relative, record.rate, fitting(short_ones, record.n()));
  if (swept)
    a.tracked = tracked_response(record, settings.harmonics, settings.bandwidth.value_or(tracker_bandwidth(record)));
  return a;
}

}  // namespace pfdm
