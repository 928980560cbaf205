#pragma once
// Measures of damage in a plane through the body.

#include "mesh/mesh.h"

namespace pfdm {

/// Area [m^2] of the plane through `point` [m] with the given `normal` (any length) inside cells with
/// damage > threshold. Exact for the surface of triangles that faces are (mesh/geometry.h). Where the plane follows
/// faces, each of the two cells counts half of their common face, and the one cell at the boundary all of it: a slice
/// in a symmetry plane is whole. Throws InputError if the normal is zero.
double damaged_area(const Mesh& mesh, const CellField<double>& damage, const Vector& point, const Vector& normal,
                    double threshold = 0.5);

}  // namespace pfdm
