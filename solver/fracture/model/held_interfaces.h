#pragma once
// Cohesive interfaces that end at the sides of a box all of which move as a homogeneous body's do (uniform
// displacement). Such sides are in one piece: they hold an interface together where it meets them, and a box that an
// interface parts would never lose its stress.

#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/body/unknowns.h"

#include <string>
#include <vector>

namespace pfdm {

/// Throws InputError, with the interface's name, where interfaces part the box so that no part of it reaches all of its
/// held sides.
void require_whole_box(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns);

/// A line for each interface that ends at a held side.
std::vector<std::string> held_interface_warnings(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
