#pragma once
// Creep and relaxation. Under held conditions the equations of a step always have the solution without any motion.
// Where the law depends on the rate and the stress is higher than it bears at rest, they have another, on which the
// plastic strain goes on: the one that rates lead to as they fall to zero.

#include "physics/endochronic.h"

#include <optional>

namespace pfdm {

/// Six conditions on the increments of one step, on_stress . d sigma + on_strain . d eps = change, a row each, scaled
/// to the size of strains.
struct StepConditions {
  MandelMatrix on_stress, on_strain;
  Mandel change;
};

/// The strain increment of the solution with the longest plastic path, nearly; nothing if the plastic strain would come
/// to rest under held conditions, so that there is no such choice. For given dzeta the step is linear: what is solved
/// is one scalar equation in dzeta, by the signs on a grid from above and bisection.
std::optional<Mandel> flowing_increment(const EndochronicLaw& law, const EndochronicState& state,
                                        const StepConditions& conditions, double dt);

}  // namespace pfdm
