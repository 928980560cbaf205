#pragma once
// Warnings on the bending of few or long cells that have gradients of one ring (bending_layers.h).

#include "solver/fracture/model/fracture_model.h"

#include <optional>
#include <string>

namespace pfdm {

/// A line on the layers that bend worst, if their stiffness in bending is wrong by more than 3 %. These are layers
/// about an axis, with a split without secant moduli, elasticity that depends on the direction, or a material that has
/// a history. In space, at finite strain and with eigenstrains they are also layers of cells much longer than the body
/// is thick, of materials one cell thick, or of one cell in all. Else hexahedra have gradients along lines
/// (layer_gradients.h) or, in plane meshes at small strain, fit cubics (cubic_faces.h), as prisms do there. Other cells
/// are warned of by 4 % (slender_layers.h), prisms that fit cubics where they are longer than the body is thick.
std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
