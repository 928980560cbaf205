#pragma once
// Whether the cells of a mesh match: a face that its neighbours cover in parts would be two boundaries of the body.

#include "mesh/mesh.h"

namespace pfdm {

/// Throws InputError that says where a point of some boundary faces is a hanging node on the edge of another, or where
/// two triangles lie on a quadrilateral. Both sides of a crack may be meshed unlike, but for edges from tip to tip.
void require_matching_cells(const Mesh& mesh);

}  // namespace pfdm
