#pragma once
// Rows of the keys of kind "endochronic".

#include "cases/program/input/config/key.h"

#include <string>
#include <vector>

namespace pfdm {

const KeyTable& endochronic_case_keys();

/// { expr }, { table } or { csv, column } in place of a plain value of a component.
const KeyTable& control_value_keys();
/// { column, unit } of a component that a test followed, and with `noise` of one that was "measured".
const KeyTable& component_column_keys();

/// "stress_xx" ... "strain_xx" ... "gamma_yz" ...
const std::vector<std::string>& point_component_keys();

}  // namespace pfdm
