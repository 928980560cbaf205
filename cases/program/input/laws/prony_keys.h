#pragma once
// Rows of the keys of Prony series, of a body or of tests on the bulk material.

#include "cases/program/input/config/key.h"

#include <string_view>
#include <vector>

namespace pfdm {

/// "shear_branches", "bulk_branches"; `only` of each: as of a row.
std::vector<Key> prony_branch_keys(std::string_view shear_only = {}, std::string_view bulk_only = {});

}  // namespace pfdm
