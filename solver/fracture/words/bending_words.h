#pragma once
// Warnings on the bending of few or long cells that have gradients of one ring (bending_layers.h).

#include "solver/fracture/model/fracture_model.h"

#include <optional>
#include <string>

namespace pfdm {

/// A line on the layers that bend worst, if their stiffness in bending is wrong by more than 3 %. These are layers
/// with a split without secant moduli, elasticity that depends on the direction, or a material that has
/// a history; elsewhere materials of one cell across, or in space of two, that have much of the bending stiffness of a
/// laminate about their own middles, and cells longer than the body is thick. Elsewhere hexahedra have gradients along
/// lines (layer_gradients.h) or, in plane meshes at small strain, fit cubics (cubic_faces.h), as prisms do there. Other
/// cells are warned of by 4 % (slender_layers.h).
std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
