#pragma once
// One structure identified from each of many records on its own, and how its parameters scatter and move over the
// schedule that the tests followed.

#include "solver/vibration/diagnosis/repeatability.h"
#include "solver/vibration/identification/identification.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// What a single record says.
struct RecordEstimates {
  std::string name;
  ScheduledRun schedule;
  std::vector<Estimate> estimates;
  double misfit = 0.0;  ///< relative
  bool converged = false;
};

struct ParameterRepeatability {
  std::string name;
  Repeatability statistics;
  /// What the noise in the single records makes: root of the mean square of their standard errors. Scatter beyond it is
  /// of the sample and the set-up.
  double expected_deviation = 0.0;
};

struct RepeatedIdentification {
  std::vector<RecordEstimates> records;
  std::vector<ParameterRepeatability> parameters;
};

/// Refines `model`, whose terms are kept, to each record; `schedule` has one entry for each. Throws ComputationError
/// that names the record that no bounded motion follows.
RepeatedIdentification identify_each(std::span<const VibrationRecord> records, std::span<const ScheduledRun> schedule,
                                     const MassMaterial& model, const IdentificationSettings& settings);

}  // namespace pfdm
