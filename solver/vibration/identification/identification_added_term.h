#pragma once
// Where a kernel with one more term starts: the equation of motion by least squares in the frequency domain, over a
// grid of the new term's rates.

#include "solver/vibration/identification/identification_values.h"

#include <optional>
#include <span>

namespace pfdm {

enum class TermKind { real, pair };

struct AddedTerm {
  MassMaterial model;
  double left = 0.0;  ///< norm of what the equation of motion leaves, each record's forces weighted to norm one
};

/// `model` with the real term or the conjugate pair with which the equation meets the records best; stiffness, damping
/// and weights and rates of the other terms are estimated anew, the damping's exponent is that of `model`. None if
/// no such term leaves a positive stiffness.
std::optional<AddedTerm> with_added_term(std::span<const VibrationRecord> records, const MassMaterial& model,
                                         TermKind kind, const IdentificationSettings& settings);

}  // namespace pfdm
