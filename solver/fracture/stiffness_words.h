#pragma once
// Warnings on cells that are too stiff on this mesh: nearly incompressible ones without a pressure unknown, and relaxed
// ones.

#include "solver/fracture/model/fracture_model.h"

#include <string>
#include <vector>

namespace pfdm {

/// A line on the cell that is least compressible, where cells that would have a pressure have none: with splits without
/// secant moduli, beside elasticity that depends on the direction, and of relaxing materials. Another line on a
/// material of nu above 0.4 that relaxes far, as the gaps at its faces meet the instantaneous moduli.
std::vector<std::string> stiffness_warnings(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
