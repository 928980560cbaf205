#pragma once
// Reads [heat]: how what a body dissipates warms it.

#include "cases/program/input/config/config.h"
#include "solver/fracture/model/fracture_model.h"

#include <optional>

namespace pfdm {

struct HeatSettings {
  HeatModel model{};
  double time = 0.0;       ///< that the mean heat of a cycle warms the body [s]; 0: not looked at
  Index time_steps = 100;  ///< in which it is gone through
};

/// `root` is the whole case file. Throws InputError for cycles that the load does not go through twice, and for a load
/// without a duration.
std::optional<HeatSettings> read_heat(const ConfigTable& root, const LoadingSettings& loading);

}  // namespace pfdm
