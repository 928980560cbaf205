#pragma once
// Imperfections of a body that would otherwise be uniform: its damage then gathers where the material is weakest.

#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

#include <cstdint>

namespace pfdm {

/// Multiplies the toughness of each damageable cell by 1 + part (2 r - 1), with independent uniform r in [0, 1) that
/// depend on the seed and on the number of the cell alone. The model's regions and cells are those of the mesh.
void perturb_toughness(const Mesh& mesh, double part, std::uint64_t seed, FractureModel& model);

}  // namespace pfdm
