#pragma once
// Rows of the keys that say what a body is made of and how it is held and loaded.

#include "cases/program/input/config/key.h"

namespace pfdm {

/// [materials.NAME]; decided by the law of the material, which the reader finds.
const KeyTable& material_keys();
/// Where only interfaces break, and there is no [fracture].
const KeyTable& elastic_material_keys();
/// As elastic_material_keys(), of a composite whose effective stiffness is wanted.
const KeyTable& composite_material_keys();
const KeyTable& region_keys();  ///< [regions.NAME]
KeyType split_type();
KeyType degradation_type();
KeyType fatigue_type();
const KeyTable& fracture_model_keys();
const KeyTable& initial_damage_keys();
const KeyTable& boundary_keys();
const KeyTable& load_keys();
const KeyTable& interface_keys();
const KeyTable& heat_keys();

/// { E1, E2 ... }, { C11, C12, C44 }, { stiffness }
const KeyTable& orthotropic_keys();
const KeyTable& cubic_keys();
const KeyTable& general_stiffness_keys();

}  // namespace pfdm
