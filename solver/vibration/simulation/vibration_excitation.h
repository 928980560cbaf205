#pragma once
// What the shaker does: the base's acceleration as a function of time, and the same at the nodes of an integration.

#include <Eigen/Core>

#include <cstdint>
#include <functional>

namespace pfdm {

/// Base acceleration on [0, duration].
struct Excitation {
  double duration = 0.0;                         ///< [s]
  double band_low = 0.0;                         ///< [Hz]
  double band_high = 0.0;                        ///< [Hz]
  std::function<double(double t)> acceleration;  ///< y''(t) [m/s^2]
  std::function<double(double t)> frequency{};   ///< driving frequency [Hz]; empty where there is none
};

/// Sine whose frequency goes from `from` to `to` (up or down), evenly in time or in the frequency's logarithm.
struct SweptSine {
  double amplitude = 0.0;  ///< [m/s^2]
  double from = 0.0;       ///< [Hz]
  double to = 0.0;         ///< [Hz]
  double duration = 0.0;   ///< [s]
  bool logarithmic = false;
  double ramp = 0.0;  ///< [s], in which the amplitude rises at the start and falls at the end, by a sine squared
};
Excitation swept_sine(const SweptSine& sweep);
Excitation harmonic(double amplitude, double frequency, double duration, double ramp);

/// Gaussian noise with a flat one-sided density between two frequencies: a sum of sines at the multiples of 1/duration
/// with random amplitudes, the same for the same seed on any machine.
struct BandLimitedRandom {
  double density = 0.0;   ///< [m^2/s^4/Hz]
  double low = 0.0;       ///< [Hz]
  double high = 0.0;      ///< [Hz]
  double duration = 0.0;  ///< [s]
  std::uint64_t seed = 1;
};
Excitation band_limited_random(const BandLimitedRandom& random);

/// Samples, and between them the band-limited signal through them.
Excitation sampled_excitation(const Eigen::VectorXd& samples, double rate, double band_low, double band_high);

/// Standard normal numbers, the same on any machine.
Eigen::VectorXd normal_numbers(Eigen::Index n, std::uint64_t seed);

/// Values at times (i + shift)/rate, 0 <= shift < 1, of the band-limited signal through samples at i/rate: sinc with a
/// Kaiser window over 24 samples, relative error below 1e-9 up to 0.23 of the rate. Before and after the record
/// the signal counts as zero.
Eigen::VectorXd shifted_samples(const Eigen::VectorXd& samples, double shift);

/// y'' where a step of the integration looks at it: per sample interval `substeps` times the four Lobatto points 0,
/// (7 - sqrt 21)/14, 1/2, (7 + sqrt 21)/14 of the substep; the end of one substep is the start of the next.
struct BaseNodes {
  double rate = 0.0;  ///< samples per second [Hz]
  int substeps = 1;
  Eigen::VectorXd values;  ///< 4 substeps (n - 1) + 1 values [m/s^2]
  Eigen::Index n_samples() const { return (values.size() - 1) / (4 * substeps) + 1; }
};
BaseNodes nodes_of(const Excitation& excitation, double rate, int substeps);
BaseNodes nodes_of(const Eigen::VectorXd& samples, double rate, int substeps);

}  // namespace pfdm
