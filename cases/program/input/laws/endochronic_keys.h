#pragma once
// Rows of the keys of an endochronic law, of a material point or of a body.

#include "cases/program/input/config/key.h"

#include <string_view>
#include <vector>

namespace pfdm {

/// "kernel", which makes a material endochronic.
std::vector<Key> kernel_keys(std::string_view otherwise);
/// "hardening", "rate", "beta".
std::vector<Key> endochronic_factor_keys(std::string_view only = {});

}  // namespace pfdm
