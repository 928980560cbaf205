#pragma once
// Rows of the keys of kind "homogenize": of a linear composite, and of a box along a path of mean strain.

#include "cases/program/input/config/key.h"

#include <string>
#include <vector>

namespace pfdm {

const KeyTable& composite_keys();
const KeyTable& debonding_keys();

/// "strain_xx" ... "gamma_xy", "stress_xx" ...
const std::vector<std::string>& mean_component_keys();

}  // namespace pfdm
