#pragma once
// Reads [fatigue]: the cycles of the load, and jumps over them.

#include "cases/program/fracture/body/materials.h"
#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "solver/fracture/model/fracture_model.h"

namespace pfdm {

const KeyTable& fatigue_cycle_keys();

/// `root` is the whole case file. Throws InputError for cycles without a material that has fatigue, and for what
/// belongs to jumps without them.
FatigueCycles read_fatigue_cycles(const ConfigTable& root, const Materials& materials);

}  // namespace pfdm
