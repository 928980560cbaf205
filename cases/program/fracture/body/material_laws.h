#pragma once
// The laws of materials in a fracture case: [materials.NAME] law.

#include "cases/program/input/config/config.h"
#include "physics/materials/material.h"

#include <memory>

namespace pfdm {

/// A row of the table of laws.
struct MaterialLaw {
  std::string_view name;
  std::string_view description;
  /// Null: linear elastic. Reads young_modulus and poisson_ratio too, which must not vary. Throws InputError.
  std::shared_ptr<const Material> (*read)(const ConfigTable& material);
};

std::span<const MaterialLaw> material_laws();
/// The law that [materials.NAME] names; without a name, linear elastic, or endochronic if there is a kernel.
const MaterialLaw& law_of_material(const ConfigTable& material);

}  // namespace pfdm
