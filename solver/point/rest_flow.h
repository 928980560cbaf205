#pragma once
// Creep and relaxation. Under held conditions the equations of a step always have the solution without any motion.
// Where the law depends on the rate and the stress is higher than it bears at rest, they have another, on which the
// plastic strain goes on: the one that rates lead to as they fall to zero.

#include "physics/point/endochronic.h"

#include <optional>

namespace pfdm {

/// Six conditions on the increments of one step, on_stress . d sigma + on_strain . d eps = change, a row each, scaled
/// to the size of strains.
struct StepConditions {
  MandelMatrix on_stress, on_strain;
  Mandel change;
};

struct RestFlow {
  bool goes_on = false;             ///< whether plastic strain would go on under held conditions: there is a choice
  std::optional<Mandel> increment;  ///< of the strain; nothing although it goes on: the step is too long to be solved
};

/// The strain increment, nearly, of the solution with the longest plastic path on which |A| falls below what the path
/// needs as the path grows. For given dzeta the step is linear: what is solved is one scalar equation in dzeta, by the
/// signs on a grid from 0.1 down, or else up, and bisection.
RestFlow flowing_increment(const EndochronicLaw& law, const EndochronicState& state, const StepConditions& conditions,
                           double dt);

}  // namespace pfdm
