#pragma once
// The keys that [materials.NAME] and [regions.NAME] have in common.

#include "cases/program/input/amount.h"
#include "physics/degradation.h"
#include "physics/materials/material.h"

#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

namespace pfdm {

/// What a material or a region's override may say.
struct MaterialKeys {
  std::optional<Parameter> young_modulus, poisson_ratio, toughness, strength, length, hydrostatic_strength,
      compressive_strength;
  std::optional<bool> damageable;
  std::optional<EnergySplit> split;
  std::optional<Degradation> degradation;
  std::optional<const SofteningLaw*> softening;
  std::shared_ptr<const Material> material{};
};

/// The keys in common, and others.
std::vector<std::string_view> keys_with(std::initializer_list<std::string_view> others);
/// All but the material.
MaterialKeys read_keys(const ConfigTable& table);
/// Those of the elasticity, and others; the material cannot be damaged.
std::vector<std::string_view> elastic_keys_with(const std::vector<std::string_view>& others);
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

}  // namespace pfdm
