#pragma once
// What a frame of a fracture run shows, by the names that other tools rely on.

#include "mesh/mesh.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/fracture/state.h"

#include <vector>

namespace pfdm {

/// damage, displacement [m], stress [Pa], strain, material, energy_density [J/m^3], driving_energy [J/m^3];
/// besides, what the histories of the materials show, as plastic_strain.
/// Points into both arguments.
std::vector<NamedField> frame_fields(const Mesh& mesh, const OutputFields& output);

}  // namespace pfdm
