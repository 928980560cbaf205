#pragma once
// Rows of the keys of Prony series, of a body or of tests on the bulk material.

#include "cases/program/input/config/key.h"

#include <string_view>
#include <vector>

namespace pfdm {

/// "shear_branches", "bulk_branches"; `only`: as of a row.
std::vector<Key> prony_branch_keys(std::string_view only = {});

}  // namespace pfdm
