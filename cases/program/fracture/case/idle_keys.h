#pragma once
// Keys that a case gives and that change nothing in it.

#include "cases/program/fracture/case/fracture_case.h"

#include <string>
#include <vector>

namespace pfdm {

/// A warning of each.
std::vector<std::string> idle_keys(const FractureCase& fracture);

}  // namespace pfdm
