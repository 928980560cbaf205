#pragma once
// What lines through a body end at.

#include "mesh/mesh.h"
#include "solver/momentum/body/unknowns.h"

namespace pfdm {

/// What a body ends at: a free face, a plane of symmetry, or a face that is held.
enum class BodyEnd : char { free, mirror, held };
/// Of the boundary faces; those within the body are free.
FaceField<BodyEnd> body_ends(const Mesh& mesh, const Unknowns& unknowns);

/// Nonzero for the boundary faces that are held across alone, and do not move that way at the end of the load: planes
/// of symmetry, and rollers at rest.
FaceField<char> resting_rollers(const Mesh& mesh, const Unknowns& unknowns);

}  // namespace pfdm
