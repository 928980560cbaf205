#pragma once
// Regular expressions of quantities for editors, which know no units library: what people write, less than UDUNITS
// takes.

#include "cases/program/input/config/config.h"

#include <string>

namespace pfdm {

/// Of a unit of that dimension, as "MPa" or "N/mm^2" of a stress; without anchors.
std::string unit_pattern(const Dimension& due);

/// Of a whole text with number and unit, as "75 MPa"; a sign that the range excludes is excluded, and so is zero.
std::string quantity_pattern(const Dimension& due, const Range& allowed);

}  // namespace pfdm
