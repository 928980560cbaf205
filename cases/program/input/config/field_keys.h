#pragma once
// Rows of the keys of a field out of a file, which may stand where a formula may.

#include "cases/program/input/config/key.h"

namespace pfdm {

/// The rows of { file, array, unit ... } and { csv, column, x ... }.
const KeyTable& field_keys();

}  // namespace pfdm
