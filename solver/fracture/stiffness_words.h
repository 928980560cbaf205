#pragma once
// Where the mesh makes bodies too stiff that are nearly incompressible without a pressure unknown, or have relaxed.

#include "solver/fracture/fracture_model.h"

#include <string>
#include <vector>

namespace pfdm {

/// A line on the cell that is least compressible, where cells that would have a pressure have none (beside materials
/// with a history, splits without secant moduli and elasticity that depends on the direction); and one on a material
/// whose instantaneous shear modulus is many times the relaxed one.
std::vector<std::string> stiffness_warnings(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
