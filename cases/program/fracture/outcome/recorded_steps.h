#pragma once
// What has to be on the disk for a run to go on from its checkpoint.

#include "cases/program/fracture/case/fracture_case.h"
#include "solver/fracture/model/state.h"

#include <filesystem>

namespace pfdm {

/// Throws InputError unless a state can be gone on from: its numbers are finite, its load not negative and its next
/// increment positive, and each file in `results` that grows with the steps (the curve; the record of `n_column_sets`
/// sets of columns; the energy release rates and the means of a box, where the case asks for them) has all of them up
/// to the state's step.
void require_steps_up_to(const FractureState& state, const std::filesystem::path& results, const FractureCase& fracture,
                         std::size_t n_column_sets);

}  // namespace pfdm
