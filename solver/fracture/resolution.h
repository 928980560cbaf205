#pragma once
// Whether the mesh and the lengths that were given can do what is asked of them.

#include "mesh/band.h"
#include "mesh/mesh.h"
#include "solver/fracture/fracture_model.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// A line for each region whose cells are too thick for ell (more than ell/2 across their thinnest direction) and for
/// each band that is too narrow for its crack's profile. A crack there would not dissipate its toughness.
std::vector<std::string> resolution_warnings(const Mesh& mesh, const FractureModel& model, std::span<const Band> bands);

}  // namespace pfdm
