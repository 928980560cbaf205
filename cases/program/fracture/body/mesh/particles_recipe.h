#pragma once
// Reads [mesh] of the generators that put particles into a box of tetrahedra.

#include "cases/program/fracture/body/mesh/mesh_recipe.h"

namespace pfdm {

MeshRecipe read_particles_in_box(const ConfigTable& table, const MeshSurroundings& around);
MeshRecipe read_packed_spheres(const ConfigTable& table, const MeshSurroundings& around);

}  // namespace pfdm
