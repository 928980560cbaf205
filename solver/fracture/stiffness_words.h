#pragma once
// Warnings on cells that are too stiff on this mesh: nearly incompressible ones without a pressure unknown, and relaxed
// ones.

#include "solver/fracture/model/fracture_model.h"

#include <string>
#include <vector>

namespace pfdm {

/// A line on the cell that is least compressible, where cells that would have a pressure have none, as with splits
/// without secant moduli or beside elasticity that depends on the direction. Another line on a material that relaxes
/// far and whose gaps do not (gaps_relax), as in plane stress: they meet the instantaneous moduli.
std::vector<std::string> stiffness_warnings(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
