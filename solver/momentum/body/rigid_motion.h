#pragma once
// A part that is not held can move rigidly, and its equilibrium is singular: every part of the mesh that is connected
// through faces must be held by itself.

#include "solver/momentum/body/unknowns.h"

namespace pfdm {

/// Throws InputError that names a part which the prescribed displacements leave free to move rigidly, and how it can
/// move. `damage`, per cell: those that are as good as broken hold nothing together; empty: there are none.
void require_held(const Mesh& mesh, const Unknowns& unknowns, const CellField<double>& damage = {});

/// place_unknowns() without this check: nothing needs to hold the body, and its stiffness may be singular.
Unknowns place_floating_unknowns(const Mesh& mesh, const ElasticBody& body);

}  // namespace pfdm
