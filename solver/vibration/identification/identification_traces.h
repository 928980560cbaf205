#pragma once
// Traces in what a model leaves of a record that are neither noise nor an error of the model: a constant tone, and what
// happens at a moment.

#include <Eigen/Core>

#include <optional>

namespace pfdm {

struct Tone {
  double frequency = 0.0;  ///< [Hz]
  double part = 0.0;       ///< of the residual's power
};
/// The strongest line in the spectrum of `x` between two frequencies [Hz] that stands out five times (in power) of
/// anything within 20 Hz, and is a twentieth of the power or more. White noise raises one in 1e8 records.
std::optional<Tone> tone_in(const Eigen::VectorXd& x, double rate, double low, double high);

struct Burst {
  double time = 0.0;   ///< after the first sample [s]
  double times = 0.0;  ///< its power over that beside it
  int number = 0;      ///< of moments as these
};
/// Moments when `x`, whitened between two frequencies [Hz], has six times the power of its surroundings or more.
std::optional<Burst> burst_in(const Eigen::VectorXd& x, double rate, double low, double high);

}  // namespace pfdm
