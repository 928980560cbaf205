#pragma once
// What the solver needs to know of a material at a place.

#include "cases/program/fracture/body/material_keys.h"
#include "cases/program/fracture/body/materials.h"

#include <string>

namespace pfdm {

/// The model of a region at x [m] by its keys and what the case says of all materials. Throws InputError of the table
/// for what a damageable region lacks, and for parameters that are out of range.
RegionModel region_model(const MaterialKeys& keys, const std::string& region, const MaterialDefaults& defaults,
                         const ConfigTable& table, const Vector& x);

}  // namespace pfdm
