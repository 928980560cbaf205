#pragma once
// Rows of the keys of kind "fracture", and of its tables that say how it is loaded and solved and what it writes.

#include "cases/program/input/config/key.h"

namespace pfdm {

const KeyTable& fracture_keys();  ///< of the whole file

const KeyTable& loading_keys();
const KeyTable& solver_keys();
const KeyTable& box_output_keys();  ///< [output] of a box along a path of mean strain
const KeyTable& cohesive_keys();
const KeyTable& experiment_keys();

}  // namespace pfdm
