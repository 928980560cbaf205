#pragma once
// Coordinates that a body can have: what is beyond comes from a damaged file or a wrong unit, and overflows in
// products.

#include <string>
#include <vector>

#include "mesh/fields.h"

namespace pfdm {

/// From the origin [m].
constexpr double farthest_point = 1e6;

/// Throws InputError that names `body` and its first point with a coordinate beyond farthest_point, or with none that
/// is a number.
void require_bounded(const std::vector<Vector>& points, const std::string& body);

}  // namespace pfdm
