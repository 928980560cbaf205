#pragma once
// Faults of records that are recognised by what they would do: the model meets the record where the fault is undone.

#include "solver/vibration/identification/identification.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

/// Where one channel is dead although the other one is not [s]. By windows, in which the equation of motion of a linear
/// sample explains next to nothing of the base's acceleration.
std::optional<std::pair<double, double>> dead_part(const VibrationRecord& record);

/// Sentences that name the faults: the sign of one channel, the mass's own acceleration instead of that relative to the
/// base, channels that are exchanged, the unit or scale of one channel, a skew between the channels from a quarter of a
/// sample to 50, samples that one channel has lost on the way, a dead part. `misfit`: of each record with the model as
/// fitted, not finite where there is none; a fault is named if undoing it leaves a third of that at most. Of a kernel
/// one term is looked at.
std::vector<std::string> recognised_faults(std::span<const VibrationRecord> records, std::span<const double> misfit,
                                           const ModelStructure& structure, const IdentificationSettings& settings);

}  // namespace pfdm
