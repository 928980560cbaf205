#pragma once
// Warnings on cells that are too stiff on this mesh: nearly incompressible ones without a pressure unknown, and relaxed
// ones; on coarse confined layers without one, which are too soft; and on cells that flow and are too strong.

#include "solver/fracture/model/fracture_model.h"

#include <string>
#include <vector>

namespace pfdm {

/// A line on the cell that is least compressible, where cells that would have a pressure have none, as with splits
/// without secant moduli or beside elasticity that depends on the direction. Another line on the thin layer of nu from
/// 0.3 on that is held on both faces and more than 3 % too soft (confined_layers.h). A third on polyhedra and pyramids
/// of plastic and endochronic materials, whose gaps do not flow (flowing_gaps.h).
std::vector<std::string> stiffness_warnings(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
