#pragma once
// What is wrong with a channel of a vibration record by itself: converters, gaps, drifts and spikes.

#include "solver/vibration/diagnosis/vibration_checks.h"

#include <Eigen/Core>

#include <vector>

namespace pfdm {

/// Adds the faults "quantised", "clipped", "dropouts", "drift" and "spikes" of a channel's samples [m/s^2], with the
/// sampling rate and the excited band [Hz]. Messages begin with the channel's name.
void check_channel(const char* channel, const Eigen::VectorXd& x, double rate, double band_low, double band_high,
                   std::vector<RecordFault>& faults);

/// The value that this part of the values does not exceed, as 0.5 for the median: one of them, the lower of two.
double sample_quantile(Eigen::VectorXd values, double part);

}  // namespace pfdm
