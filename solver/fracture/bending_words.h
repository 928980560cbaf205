#pragma once
// What a run does to the bending of few or long cells where they have gradients of one ring (bending_layers.h).

#include "solver/fracture/fracture_model.h"

#include <optional>
#include <string>

namespace pfdm {

/// A line on the layers that bend worst, if their stiffness in bending is wrong by more than 3 %: about an axis, at
/// finite strain, with a split without secant moduli, elasticity that depends on the direction, or a material that has
/// a history; in space also where LinesInSpace do not cover them. Else hexahedra fit cubics (cubic_faces.h) or have
/// gradients along lines (layer_gradients.h).
std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
