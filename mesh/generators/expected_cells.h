#pragma once
// How many cells a mesh would have, before it is made.

#include "mesh/surfaces/size_field.h"

#include <limits>
#include <string>

namespace pfdm {

inline constexpr double regular_volume = 0.1178;  ///< sqrt(2)/12: a regular tetrahedron of unit edge
inline constexpr double most_cells =
    std::numeric_limits<Index>::max() / 24.0;  ///< that can be numbered with what they have

/// Throws InputError if a run on so many cells takes more memory than this machine has, or if they are too many to
/// number; `what` they are: "the box".
void require_memory_for(double cells, const std::string& what);

/// Tetrahedra between these corners [m], by the volume of regular ones. About spheres 0.87 to 1.35 times as many came,
/// about grains up to 1.95, of meshes of 10,000 to 140,000 of them.
double expected_tetrahedra(const SizeField& size, const Vector& lower, const Vector& upper);

}  // namespace pfdm
