#pragma once
// Reads [heat]: how what a body dissipates warms it.

#include "cases/program/input/config/config.h"
#include "solver/fracture/model/fracture_model.h"

#include <optional>

namespace pfdm {

/// `root` is the whole case file. Throws InputError for cycles that the load does not go through twice, and for a load
/// without a duration.
std::optional<HeatModel> read_heat(const ConfigTable& root, const LoadingSettings& loading);

}  // namespace pfdm
