#pragma once
// The table [fracture]: the model of damage, its degradation, split and strength.

#include "cases/program/fracture/body/materials.h"
#include "cases/program/input/config/config.h"
#include "solver/fracture/model/fracture_model.h"

#include <cstdint>

namespace pfdm {

/// Random changes of the cells' toughness, so that a uniform body has a weakest place.
struct Perturbation {
  double part = 0.0;  ///< of the toughness; 0: none
  std::uint64_t seed = 1;
};

/// Reads [fracture] into the model, and what it says of all materials. Throws InputError where one excludes another.
MaterialDefaults read_fracture_model(const ConfigTable& root, FractureModel& model);

/// Reads the perturbation of [fracture], if there is one.
Perturbation read_perturbation(const ConfigTable& root);

/// The choices of bodies in which only interfaces break.
MaterialDefaults elastic_model(FractureModel& model);

}  // namespace pfdm
