#pragma once
// Charts of vibration records, for the pages of pfdm report.

#include "postproc/page/report_page.h"
#include "postproc/vibration/vibration_fit.h"
#include "solver/vibration/diagnosis/record_analysis.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pfdm {

double rms_of(const Eigen::VectorXd& signal);

/// A signal [m/s^2] in g0, as the band between its least and largest values in each of some hundred intervals.
Series hull(const std::string& label, const Eigen::VectorXd& signal, double rate, int colour);
Chart base_chart(const VibrationRecord& record);
Chart response_chart(const VibrationRecord& record);

/// What spectra say within the excited band.
struct BandSpectra {
  std::vector<double> frequency;                   ///< [Hz]
  std::vector<double> base, relative;              ///< [g0^2/Hz]
  std::vector<double> magnitude, lower, upper;     ///< |H1| and its 95 % bounds
  std::vector<double> phase;                       ///< of H1 [degrees]
  std::vector<double> magnitude_h2, magnitude_hv;  ///< |H2|, |Hv|
  std::vector<double> coherence, coherence_lower, coherence_upper;
};
BandSpectra in_band(const Spectra& spectra, const VibrationRecord& record);
/// Of another response to the record's base acceleration.
BandSpectra spectra_in_band(const VibrationRecord& record, const Eigen::VectorXd& relative, SegmentSettings segments);

inline constexpr double least_coherence = 0.2;  ///< for responses to be shown
/// Interrupts the responses where the record's coherence says that they mean nothing, as beyond the ends of a sweep.
void blank_incoherent(BandSpectra& spectra, const std::vector<double>& coherence);

ChartAxis frequency_axis(const VibrationRecord& record);
Chart density_chart(const VibrationRecord& record, const BandSpectra& spectra);
Chart coherence_chart(const VibrationRecord& record, const BandSpectra& spectra);

/// Storage and loss modulus of a sample over the frequency; of one row at least.
Chart modulus_chart(const std::vector<ModulusRow>& modulus);

/// Density of the response over time and frequency, up to a little beyond the highest harmonic asked for.
Picture spectrogram_picture(const Spectrogram& spectrogram, double highest_frequency);
/// The response at the driving frequency and its harmonics over that frequency.
Chart harmonics_chart(const TrackedResponse& tracked);

}  // namespace pfdm
