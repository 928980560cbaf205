#include "cases/program/fracture/material_keys.h"

#include "cases/program/fracture/body_loads.h"
#include "cases/program/input/heat_units.h"
#include "cases/program/input/law_reader.h"
#include "physics/effective_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace pfdm {
namespace {

/// A quantity of a material, which may vary in space.
struct Quantity {
  std::string_view key;
  std::optional<Parameter> MaterialKeys::*value;
  const Dimension& due;
  const Range& allowed = range::positive;
};
const Quantity quantities[] = {
    {"young_modulus", &MaterialKeys::young_modulus, dimension::stress},
    {"poisson_ratio", &MaterialKeys::poisson_ratio, dimension::number, range::poisson_ratio},
    {"toughness", &MaterialKeys::toughness, dimension::toughness},
    {"strength", &MaterialKeys::strength, dimension::stress},
    {"length", &MaterialKeys::length, dimension::length},
    {"hydrostatic_strength", &MaterialKeys::hydrostatic_strength, dimension::stress},
    {"compressive_strength", &MaterialKeys::compressive_strength, dimension::stress},
    {"density", &MaterialKeys::density, dimension::density},
};
constexpr std::size_t n_elastic = 2;  // the first of them
constexpr std::string_view choices[] = {"damageable", "split",       "degradation", "softening",
                                        "expansion",  "eigenstrain", "elasticity",  "axes"};

/// One value, or three along x, y and z.
std::array<Parameter, 3> read_expansion(const ConfigValue& value) {
  const auto read = [](const ConfigValue& one) { return read_parameter(one, dimension::per_temperature, range::any); };
  if (!value.is_list()) {
    const Parameter all = read(value);
    return {all, all, all};
  }
  const std::vector<ConfigValue> entries = value.list(3);
  return {read(entries[0]), read(entries[1]), read(entries[2])};
}

// In place of Young's modulus and Poisson's ratio, of which the closest ones stand in estimates.
void read_stiffness(const ConfigTable& table, const ConfigValue& value, MaterialKeys& keys) {
  for (const char* key : {"young_modulus", "poisson_ratio"})
    if (const auto other = table.find(key)) throw other->error("the material has its elasticity already");
  keys.stiffness = std::make_shared<const MandelMatrix>(read_anisotropic(value));
  const IsotropicElasticity closest = closest_isotropic(*keys.stiffness);
  const auto constant = [](double number) {
    return Parameter{.at = [number](const Vector&) { return number; }, .text = fmt::format("{}", number)};
  };
  keys.young_modulus = constant(closest.young_modulus());
  keys.poisson_ratio = constant(closest.poisson_ratio());
}

template <class T>
void override_by(const std::optional<T>& by, std::optional<T>& value) {
  if (by) value = by;
}

}  // namespace

std::vector<std::string_view> keys_with(std::initializer_list<std::string_view> others) {
  std::vector<std::string_view> keys(others);
  for (const Quantity& quantity : quantities) keys.push_back(quantity.key);
  keys.insert(keys.end(), std::begin(choices), std::end(choices));
  return keys;
}

bool any_varies(const MaterialKeys& keys) {
  if (keys.expansion && std::ranges::any_of(*keys.expansion, &Parameter::varies)) return true;
  if (keys.axes && keys.axes->varies) return true;
  return std::ranges::any_of(quantities, [&](const Quantity& quantity) {
    const std::optional<Parameter>& value = keys.*quantity.value;
    return value && value->varies;
  });
}

MaterialKeys read_keys(const ConfigTable& table, bool loads_from_start) {
  MaterialKeys keys;
  for (const auto& [key, member, due, allowed] : quantities)
    if (const auto value = table.find(key)) keys.*member = read_parameter(*value, due, allowed);
  if (const auto value = table.find("damageable")) keys.damageable = value->boolean();
  if (const auto value = table.find("split")) keys.split = read_split(*value);
  if (const auto value = table.find("degradation")) keys.degradation = read_degradation(*value);
  if (const auto value = table.find("expansion")) keys.expansion = read_expansion(*value);
  if (const auto value = table.find("elasticity")) read_stiffness(table, *value, keys);
  if (const auto value = table.find("axes")) keys.axes = read_axes(*value);
  if (const auto value = table.find("eigenstrain")) keys.eigenstrain = read_eigenstrain(*value, loads_from_start);
  if (const auto value = table.find("softening")) keys.softening = &choose(*value, softening_laws(), "softening law");
  return keys;
}

std::vector<std::string_view> elastic_keys_with(const std::vector<std::string_view>& others) {
  std::vector<std::string_view> keys(others);
  for (const Quantity& quantity : std::span(quantities).first(n_elastic)) keys.push_back(quantity.key);
  return keys;
}

MaterialKeys read_elastic_keys(const ConfigTable& table) {
  MaterialKeys keys;
  for (const auto& [key, member, due, allowed] : std::span(quantities).first(n_elastic))
    keys.*member = read_parameter(table.at(key), due, allowed);
  keys.damageable = false;
  return keys;
}

MaterialKeys overridden(MaterialKeys base, const MaterialKeys& by) {
  for (const Quantity& quantity : quantities) override_by(by.*quantity.value, base.*quantity.value);
  override_by(by.damageable, base.damageable);
  override_by(by.expansion, base.expansion);
  override_by(by.axes, base.axes);
  if (by.eigenstrain) base.eigenstrain = by.eigenstrain;
  if (by.stiffness) base.stiffness = by.stiffness;
  override_by(by.split, base.split);
  override_by(by.degradation, base.degradation);
  override_by(by.softening, base.softening);
  return base;
}

EnergySplit read_split(const ConfigValue& value) {
  const auto [law, p] = choose_law(value, energy_splits(), "energy split");
  return {*law, p};
}

Degradation read_degradation(const ConfigValue& value) {
  const auto [law, p] = choose_law(value, degradations(), "degradation function");
  return {*law, p};
}

}  // namespace pfdm
