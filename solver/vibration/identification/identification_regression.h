#pragma once
// Least squares of the equation of motion: its terms are the columns of a linear system, so that the parameters need no
// start.

#include "physics/point/mass_material.h"
#include "solver/vibration/identification/identification_values.h"
#include "solver/vibration/simulation/vibration_record.h"

#include <optional>
#include <span>

namespace pfdm {

/// Parameters that fit a linear system of the equation's terms.
struct Regression {
  MassMaterial model;
  double misfit = 0.0;  ///< norm of the residual over that of the left side
};

/// For structures without kernel, or with a single term.
Regression regress_states(std::span<const VibrationRecord> records, const ModelStructure& structure,
                          const IdentificationSettings& settings);

/// None if no choice of rates gives `kernel_order` terms that all dissipate.
std::optional<Regression> regress_separable(std::span<const VibrationRecord> records, const ModelStructure& structure,
                                            int kernel_order, const IdentificationSettings& settings);

}  // namespace pfdm
