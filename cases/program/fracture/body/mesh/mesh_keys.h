#pragma once
// Rows of the keys of [mesh], for every generator.

#include "cases/program/input/config/key.h"

namespace pfdm {

const KeyTable& mesh_keys();

}  // namespace pfdm
