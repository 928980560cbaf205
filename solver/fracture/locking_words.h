#pragma once
// What a run does to nearly incompressible bodies whose cells have no pressure unknown.

#include "solver/fracture/fracture_model.h"

#include <optional>
#include <string>

namespace pfdm {

/// A line on the cell that is least compressible, where cells that would have a pressure have none: beside materials
/// with a history, splits without secant moduli and elasticity that depends on the direction.
std::optional<std::string> locking_warning(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
