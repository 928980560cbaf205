#pragma once
// What a run does to the bending of few or long cells where they have gradients of one ring (bending_layers.h).

#include "solver/fracture/fracture_model.h"

#include <optional>
#include <string>

namespace pfdm {

/// Whether the stiffness of hexahedra in layers comes from gradients of one ring: in space, about an axis, at finite
/// strain, with a split without secant moduli, elasticity that depends on the direction, or a material that has a
/// history. Else they fit cubics (cubic_faces.h).
bool bends_by_one_ring(const FractureModel& model);

/// A line on the layers that bend worst, if their stiffness in bending is wrong by more than 3 %.
std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
