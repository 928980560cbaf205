#pragma once
// Samples that one channel lost on the way: from some time on it runs ahead of the other one.

#include "solver/vibration/simulation/vibration_record.h"

#include <optional>

namespace pfdm {

struct LostSamples {
  double time = 0.0;         ///< from about here on [s]
  int number = 0;            ///< the relative channel lacks so many samples; negative: the base
  double unexplained = 0.0;  ///< rms of the base that the equation of motion leaves, over that without the shift
  VibrationRecord longer{};  ///< the longer of the two parts, its channels in step
};

/// By the equation of motion of a mass on k_1 z ... k_N z^N and a damper, with the base shifted by up to 50 samples
/// from one of 40 times on. None if no shift leaves less than 0.7 of what is left as recorded; whether the model meets
/// the part then is for the caller to see.
std::optional<LostSamples> lost_samples(const VibrationRecord& record, int stiffness_order);

}  // namespace pfdm
