#pragma once
// Rows of the keys of kind "viscoelastic".

#include "cases/program/input/config/key.h"

namespace pfdm {

const KeyTable& viscoelastic_case_keys();

/// { column, unit } of a column that a test followed, and with `noise` or `relative_noise` of one that was "measured".
const KeyTable& test_column_keys();

}  // namespace pfdm
