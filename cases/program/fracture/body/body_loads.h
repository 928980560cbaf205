#pragma once
// What acts within the body, [loads]: gravity, body forces, a change of temperature; and eigenstrains of materials.

#include "cases/program/input/config/config.h"
#include "solver/fracture/model/fracture_model.h"

#include <memory>

namespace pfdm {

/// Reads [loads], which may be missing.
BodyLoads read_body_loads(const ConfigTable& root);

/// Whether plain quantities act from the first step on (applied = "from_start"), and do not grow with the load.
bool apply_from_start(const ConfigTable& root);

/// Three or six numbers, or expressions with t: the eigenstrain's xx, yy, zz and yz, xz, xy [-].
std::shared_ptr<const LoadField<Tensor>> read_eigenstrain(const ConfigValue& value, bool from_start);

/// Throws InputError for a temperature in place of a difference, as "20 degC".
void require_temperature_difference(const ConfigValue& value);

/// Throws InputError if there is a load without a material on which it acts: gravity on a region without a density, a
/// change of temperature where nothing expands. Such a load without a value somewhere is found by evaluating all of
/// them in the cells at these load parameters.
void require_body_loads(const ConfigTable& root, const FractureModel& model, const Mesh& mesh,
                        std::span<const double> loads);

}  // namespace pfdm
