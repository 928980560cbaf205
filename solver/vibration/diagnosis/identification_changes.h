#pragma once
// Samples that are not the same from test to test, or from the beginning of a test to its end.

#include "solver/vibration/identification/identification.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// Sentences that name changes which explain what the model leaves: records that it meets by themselves and not
/// together (up to eight records), also as if by another mass; and the first and last quarter of a record that is not
/// swept. `misfit`: of each record with the model as fitted to all; by itself it has to leave a third at most.
std::vector<std::string> changes_of_sample(std::span<const VibrationRecord> records, std::span<const double> misfit,
                                           const MassMaterial& model, const IdentificationSettings& settings);

}  // namespace pfdm
