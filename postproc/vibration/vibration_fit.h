#pragma once
// What fit.json tells of the mass-material model alone. SI units, units in the names.

#include "postproc/fits/fit_json.h"
#include "solver/vibration/diagnosis/identification_repeats.h"
#include "solver/vibration/simulation/ogden_fit.h"

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Young's modulus of the sample at a frequency: K L/A.
struct ModulusRow {
  double frequency = 0.0;  ///< [Hz]
  double storage = 0.0;    ///< E' [Pa]
  double loss = 0.0;       ///< E'' [Pa]
};

struct VibrationFindings {
  std::string structure;
  Passivity passivity;
  std::vector<OrderTrial> orders;
  std::vector<ModulusRow> modulus;
  std::optional<OgdenFit> ogden;  ///< of the stiffness polynomial
  std::optional<RepeatedIdentification> repeats;
};

OwnFindings own_findings(const VibrationFindings& findings);

/// Without what no report shows: passivity and orders; nothing of a fit of another kind of case. Throws InputError for
/// text that is no such findings.
std::optional<VibrationFindings> vibration_findings(const OwnFindings& own);

}  // namespace pfdm
