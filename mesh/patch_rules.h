#pragma once
// The usual rules that name boundary faces: planes, boxes, and the six sides of a box.

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace pfdm {

/// Boundary faces whose centre lies within tolerance [m] of the plane axis = value [m] (axis 0, 1, 2 for x, y, z) and
/// whose normal is along that axis to within about 8 degrees. Throws InputError for an axis there is not.
PatchRule plane_patch(std::string name, int axis, double value, double tolerance);

/// Boundary faces whose centre lies in the box between two corners, to within tolerance [m].
PatchRule patch_within(std::string name, const Vector& lower, const Vector& upper, double tolerance);

/// xmin, xmax, ymin, ymax, zmin, zmax of the box between two corners [m].
std::vector<PatchRule> box_patches(const Vector& lower, const Vector& upper);

}  // namespace pfdm
