#pragma once
// checkpoint.bin: the state of a fracture run, bit for bit, for a restart.

#include "solver/fracture/model/state.h"

#include <filesystem>
#include <string>

namespace pfdm {

/// Written whole or not at all; throws ComputationError if the file cannot be written. `case_hash` says which case the
/// state belongs to.
void write_checkpoint(const std::filesystem::path& path, const FractureState& state, const std::string& case_hash);

/// Throws InputError if the file cannot be read, is not a checkpoint, is truncated or corrupt (checksum), has another
/// version's format; OtherCase if it belongs to another case.
FractureState read_checkpoint(const std::filesystem::path& path, const std::string& case_hash);

/// Whether all numbers of a state are finite; how the heat of cycles changes (HeatState) is infinite before there are
/// two.
bool is_finite(const FractureState& state);

}  // namespace pfdm
