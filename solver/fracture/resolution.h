#pragma once
// Whether the mesh and the lengths that were given can do what is asked of them.

#include "mesh/band.h"
#include "mesh/mesh.h"
#include "solver/fracture/fracture_model.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// A line for each region whose cells are too thick for ell (more than ell/2 across their thinnest direction), and for
/// each band whose cells are too wide for ell (more than ell along it in the mean) or that is too narrow for its
/// crack's profile. A crack there would not dissipate its toughness, or its front would not be resolved.
std::vector<std::string> resolution_warnings(const Mesh& mesh, const FractureModel& model, std::span<const Band> bands);

/// A line for each region of hexahedra in which cracks may choose a direction: what its rows of cells do to that, and
/// to the surface energy (tests/verification/README.md has the measurements).
std::vector<std::string> direction_remarks(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
