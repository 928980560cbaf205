#pragma once
// One model structure identified from the records of a mass-material case, and judged.

#include "cases/program/session/terminal/log.h"
#include "cases/program/vibration/mass_material_case.h"
#include "postproc/fits/fit_json.h"
#include "postproc/vibration/vibration_fit.h"
#include "solver/vibration/identification/identification.h"
#include "solver/vibration/identification/identification_ten_steps.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct MassMaterialRecords {
  std::vector<VibrationRecord> fitted;
  std::vector<VibrationRecord> predicted;
};

/// Found model and what is told about it.
struct IdentifiedModel {
  MassMaterial model;
  FitReport report{};
  VibrationFindings own{};
  std::vector<std::string> doubts{};                      ///< of the method itself
  double bic = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not of this method
  std::optional<TenSteps> ten_steps{};                    ///< of that method alone
};

/// What [fit] asks for; `log`, if any, is told what is being done.
IdentificationSettings settings_of(const MassMaterialCase& c, Log* log = nullptr);

/// By the method of [fit], with its misfits and its verdict. Throws ComputationError where no parameters are found,
/// with the faults of the records that may be why.
IdentifiedModel identified(const MassMaterialRecords& records, const ModelStructure& structure,
                           const MassMaterialCase& c, Log& log);

}  // namespace pfdm
