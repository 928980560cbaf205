#pragma once
// Identification of the mass-material model from vibration records: the parameters with which the equation, or its
// solution, fits the measurements. Methods (the report is AFRL-RW-EG-TR-2016-088):
//
//   regress_states     the report's continuous-time least squares (A4.2): the terms of the equation of motion are the
//                      columns of a linear system; with one kernel term by its third-order equation
//   ten_steps          the report's iteration for more terms (A4.3)
//   regress_separable  any number of terms: for given rates alpha their convolutions are columns too
//   refine_output      output error: the simulated response to the measured base acceleration is to be the measured
//                      one, all records at once
//   identify           the whole: separable start, output error, order of the kernel by BIC, intervals by bootstrap

#include "physics/point/mass_material.h"
#include "solver/vibration/identification/identification_output_error.h"
#include "solver/vibration/identification/identification_regression.h"
#include "solver/vibration/identification/identification_values.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <span>
#include <vector>

namespace pfdm {

struct Identification {
  OutputErrorFit fit;
  Regression start;
  std::vector<OrderTrial> orders;       ///< that were tried
  Passivity passivity;                  ///< over the excited band
  std::vector<InitialMotion> starts{};  ///< of each record; none where all begin at rest
};

/// Records that begin in motion are told from the others by what the model leaves, and the motion is estimated with the
/// parameters. Throws ComputationError if no parameters can be found.
Identification identify(std::span<const VibrationRecord> records, const ModelStructure& structure,
                        const IdentificationSettings& settings);

}  // namespace pfdm
