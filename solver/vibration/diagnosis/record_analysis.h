#pragma once
// What a record says without a model: level, spectra, frequency responses with their bounds, spectrogram, and of a sine
// the response at the driving frequency and its harmonics.

#include "solver/vibration/signals/signals_spectra.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <optional>

namespace pfdm {

struct AnalysisSettings {
  SegmentSettings segments{};
  std::optional<Eigen::Index> spectrogram_length{};  ///< samples; none: spectrogram_segments()
  int harmonics = 3;                                 ///< of the driving frequency, itself included
  std::optional<double> bandwidth{};                 ///< of their filters [Hz]; none: tracker_bandwidth()
};

/// How hard the test was.
struct TestLevel {
  double rms_base = 0.0, rms_relative = 0.0;    ///< [m/s^2]
  double peak_base = 0.0, peak_relative = 0.0;  ///< [m/s^2]
  double base_density = 0.0;                    ///< mean over the excited band [m^2/s^4/Hz]
};

/// Of a sine: the response at multiples of the driving frequency, some forty times a second.
struct TrackedResponse {
  Eigen::VectorXd time;               ///< [s]
  Eigen::VectorXd frequency;          ///< that drives [Hz]
  Eigen::VectorXd base;               ///< amplitude of the base's acceleration at it [m/s^2]
  Eigen::MatrixXd harmonics;          ///< amplitudes of the relative acceleration, a column each [m/s^2]
  Eigen::VectorXd envelope;           ///< of the relative acceleration, all of it [m/s^2]
  double bandwidth = 0.0;             ///< [Hz]
  double median_base() const;         ///< the test's level [m/s^2]
  Eigen::Index at_resonance() const;  ///< where the first harmonic is largest over the base
};

struct RecordAnalysis {
  TestLevel level;
  SegmentSettings segments;  ///< as used
  Spectra spectra;           ///< of base and relative acceleration
  Eigen::VectorXcd H1, H2, Hv;
  Bounds H1_bounds;                 ///< of |H1|, 95 %
  Eigen::VectorXd phase_deviation;  ///< standard deviation of the phase of H1 [rad]
  Eigen::VectorXd coherence;
  Bounds coherence_bounds;                   ///< 95 %
  Spectrogram spectrogram;                   ///< of the relative acceleration
  std::optional<TrackedResponse> tracked{};  ///< none: no sine drives
};

/// Segments longer than the record are cut to it. Throws InputError for other settings that cannot be.
RecordAnalysis analysed(const VibrationRecord& record, const AnalysisSettings& settings);

/// Of a sine at one frequency at a time; its phase is that of the base's acceleration.
TrackedResponse tracked_response(const VibrationRecord& record, int n_harmonics, double bandwidth);
double tracker_bandwidth(const VibrationRecord& record);  ///< 4 Hz, and at most 0.4 of the lowest frequency

/// Samples of a segment that shows a sweep best: as long as the frequency takes to cross the segment's own resolution,
/// a power of two. Of other motion a sixteenth of the record, 256 to 4096.
Eigen::Index spectrogram_segments(const VibrationRecord& record, bool swept);

/// Every so many of the record's samples are some forty a second.
Eigen::Index tracker_stride(double rate);

}  // namespace pfdm
