#pragma once
// A line cut into graded blocks of cells: the axes of structured meshes.

#include <string_view>
#include <vector>

#include "mesh/fields.h"

namespace pfdm {

/// A stretch of an axis cut into n cells whose widths grow geometrically.
struct AxisBlock {
  double length = 0.0;  ///< [m], or [rad] along an angle, > 0
  Index n = 1;          ///< >= 1
  double ratio = 1.0;   ///< width of the last cell over that of the first, > 0
};

/// The nodes of blocks of which each begins where the one before it ends, the first at `origin`. Throws InputError for
/// no block, or one that is not positive; `where` begins the message, as in "the box along x".
std::vector<double> axis_nodes(double origin, const std::vector<AxisBlock>& blocks, std::string_view where);

/// Of sectors that are one cell wide: throws InputError unless the width [rad] is positive and at most pi/4, and the
/// inner radius [m] zero or positive.
void check_sector(double azimuth, double inner_radius);

}  // namespace pfdm
