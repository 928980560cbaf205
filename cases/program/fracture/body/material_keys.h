#pragma once
// The keys that [materials.NAME] and [regions.NAME] have in common.

#include "cases/program/fracture/body/anisotropy_reader.h"
#include "cases/program/input/fields/amount.h"
#include "physics/damage/degradation.h"
#include "solver/fracture/model/fracture_model.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace pfdm {

/// What a material or a region's override may say.
struct MaterialKeys {
  std::optional<Parameter> young_modulus, poisson_ratio, toughness, strength, length, hydrostatic_strength,
      compressive_strength, density, conductivity, specific_heat;
  std::optional<std::array<Parameter, 3>> expansion;  // [1/K]
  std::shared_ptr<const LoadField<Tensor>> eigenstrain{};
  std::shared_ptr<const MandelMatrix> stiffness{};  // along the axes; the moduli above are then the closest ones
  std::optional<MaterialAxes> axes;
  std::optional<bool> damageable;
  std::optional<EnergySplit> split;
  std::optional<Degradation> degradation;
  std::optional<Fatigue> fatigue;
  std::optional<const SofteningLaw*> softening;
  std::shared_ptr<const Material> material{};
};

/// All but the material. With `loads_from_start` a plain eigenstrain does not grow with the load.
MaterialKeys read_keys(const ConfigTable& table, bool loads_from_start);
/// Those of the elasticity; the material cannot be damaged.
MaterialKeys read_elastic_keys(const ConfigTable& table);
/// `base`, where `by` says nothing else.
MaterialKeys overridden(MaterialKeys base, const MaterialKeys& by);
/// Whether any quantity depends on the place.
bool any_varies(const MaterialKeys& keys);

inline std::optional<double> value_at(const std::optional<Parameter>& parameter, const Vector& x) {
  return parameter ? std::optional(parameter->at(x)) : std::nullopt;
}

/// "name", or { law = "name", parameter = ... }.
EnergySplit read_split(const ConfigValue& value);
Degradation read_degradation(const ConfigValue& value);
/// { law = "name", threshold = ..., parameter = ... }.
Fatigue read_fatigue(const ConfigValue& value);

}  // namespace pfdm
