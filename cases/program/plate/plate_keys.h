#pragma once
// Rows of the keys of kind "plate".

#include "cases/program/input/config/key.h"

namespace pfdm {

const KeyTable& plate_keys();

}  // namespace pfdm
