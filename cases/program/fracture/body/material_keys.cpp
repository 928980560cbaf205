#include "cases/program/fracture/body/material_keys.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/body_loads.h"
#include "cases/program/fracture/body/material_laws.h"
#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/laws/endochronic_keys.h"
#include "cases/program/input/laws/law_reader.h"
#include "cases/program/input/laws/prony_keys.h"
#include "cases/program/input/laws/temperature_shift_reader.h"
#include "physics/elasticity/effective_stiffness.h"

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
  const Range& allowed;
  std::string_view otherwise, sentence;
};
const Quantity quantities[] = {
    {"young_modulus", &MaterialKeys::young_modulus, dimension::stress, range::positive, "or elasticity",
     "Young's modulus E, the elastic stiffness in uniaxial tension."},
    {"poisson_ratio", &MaterialKeys::poisson_ratio, dimension::number, range::poisson_ratio, "or elasticity",
     "Poisson's ratio nu, transverse contraction; above 0.47 (nearly incompressible) cells carry a pressure unknown."},
    {"toughness", &MaterialKeys::toughness, dimension::toughness, range::positive, "none: required where damageable",
     "Fracture toughness, critical energy release rate Gc per crack area, also called fracture energy."},
    {"strength", &MaterialKeys::strength, dimension::stress, range::positive,
     "none: required by rational and by strength",
     "Tensile strength ft in uniaxial tension, of cohesive phase fields and of the model of strength."},
    {"length", &MaterialKeys::length, dimension::length, range::positive, "that of [fracture]",
     "Phase-field length ell of this material, the width over which a crack is smeared."},
    {"hydrostatic_strength", &MaterialKeys::hydrostatic_strength, dimension::stress, range::positive,
     "required by the model strength, or compressive_strength",
     "Strength in hydrostatic tension, of the model of strength."},
    {"compressive_strength", &MaterialKeys::compressive_strength, dimension::stress, range::positive,
     "required by the model strength, or hydrostatic_strength",
     "Strength in uniaxial compression, of the model of strength."},
    {"density", &MaterialKeys::density, dimension::density, range::positive, "none",
     "Mass density, on which gravity acts; damage takes no weight away."},
    {"conductivity", &MaterialKeys::conductivity, dimension::conductivity, range::positive, "required with [heat]",
     "Thermal conductivity, also of damaged material; at finite strain of the undeformed body."},
    {"specific_heat", &MaterialKeys::specific_heat, dimension::specific_heat, range::positive, "required with [heat]",
     "Specific heat capacity per mass."},
};
constexpr std::size_t n_elastic = 2;  // the first of them

std::vector<Key> rows_of(std::span<const Quantity> some) {
  std::vector<Key> rows;
  for (const Quantity& q : some)
    rows.push_back({q.key,
                    keys::varying(q.due.name == dimension::number.name ? keys::number(q.allowed)
                                                                       : keys::quantity(q.due, q.allowed)),
                    std::string(q.otherwise), q.sentence});
  return rows;
}

const KeyTable& axes_keys() {
  using namespace keys;
  const KeyType along = list(varying(number()), 3, 3);
  static const KeyTable table{
      .name = "axes",
      .sentence = "The axes of an anisotropic material.",
      .keys = {{"first", along, "", "Direction of the material's axis 1, three numbers or formulas of the place."},
               {"second", along, "", "Direction of the material's axis 2, as far as it is normal to the first."}}};
  return table;
}

const KeyTable& band_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "band",
      .sentence = "A thin band between two regions, such as an adhesive layer.",
      .keys = {
          {"width", quantity(dimension::length, range::positive), "", "Thickness of the band between the two regions."},
          {"between", list(text("region"), 2, 2), "", "Names of the two regions that the band lies between."}}};
  return table;
}

Key regions_row() {
  return {"regions", keys::list(keys::text("region")), "", "Names of the mesh's regions that are of this material."};
}

std::vector<Key> overriding(std::vector<Key> rows) {
  for (Key& row : rows) row.otherwise = "that of the material";
  return rows;
}

std::vector<Key> anisotropy_rows() {
  using namespace keys;
  return {
      {"elasticity", either({table(orthotropic_keys), table(cubic_keys), table(general_stiffness_keys)}), "isotropic",
       "Anisotropic elasticity in place of Young's modulus and Poisson's ratio: orthotropic, cubic or general."},
      {"axes", table(axes_keys), "x, y, z", "Axes of an anisotropic material, uniform or fields, as of fibres."}};
}

/// Of materials and of regions.
std::vector<Key> rows_in_common() {
  using namespace keys;
  const KeyType expansion = varying(quantity(dimension::per_temperature)), strain = varying(number());
  return joined(
      {rows_of(quantities),
       {{"damageable", flag(), "true", "Whether damage may grow here; false for bodies that only deform."},
        {"split", split_type(), "that of [fracture]", "Energy split of this material alone."},
        {"degradation", degradation_type(), "that of [fracture]", "Degradation function of this material alone."},
        {"softening", one_of("softening law", softening_laws()), "that of [fracture]",
         "Softening law of this material alone."},
        {"fatigue", fatigue_type(), "none",
         "Fatigue: how the toughness falls with the driving energy that cycles of load accumulate."},
        {"expansion", either({expansion.parts[0], expansion.parts[1], list(expansion, 3, 3)}), "0",
         "Coefficient of thermal expansion, one or three along x, y, z or the material's axes."},
        {"eigenstrain", list(strain, 3, 6), "0",
         "Strain that makes no stress (misfit, shrinkage, swelling): three components xx, yy, zz or six."}},
       anisotropy_rows()});
}

/// One value, or three along x, y and z.
std::array<Parameter, 3> read_expansion(const ConfigValue& value) {
  if (!value.is_list()) {
    const Parameter all = read_parameter(value);
    return {all, all, all};
  }
  const std::vector<ConfigValue> entries = value.list(3);
  return {read_parameter(entries[0]), read_parameter(entries[1]), read_parameter(entries[2])};
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

const KeyTable& region_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "regions.NAME",
      .sentence = "What a region has otherwise than its material.",
      .keys = joined({overriding(rows_in_common()),
                      {{"band", keys::table(band_keys), "none",
                        "Says that the region is a thin band between two others, with corrected toughness."}}})};
  return table;
}

const KeyTable& material_keys() {
  using namespace keys;
  constexpr std::string_view j2 = "j2_plasticity", powers = "ogden lopez_pamies",
                             volumetric = "neo_hookean mooney_rivlin ogden lopez_pamies",
                             viscous = "prony neo_hookean mooney_rivlin ogden lopez_pamies";
  static const KeyTable table{
      .name = "materials.NAME",
      .sentence = "A material: elasticity, fracture, the law of the undamaged material.",
      .keys = joined(
          {{regions_row(),
            {"law", one_of("law of a material", material_laws()), "linear elastic; endochronic if there is a kernel",
             "Law of the undamaged material: linear elastic, plastic, viscoelastic, or hyperelastic (rubber) at finite "
             "strain."}},
           rows_in_common(),
           kernel_keys("none"),
           endochronic_factor_keys("endochronic"),
           {{"yield_stress", quantity(dimension::stress, range::positive), "",
             "Yield stress in uniaxial tension (von Mises).", j2},
            {"isotropic_hardening", quantity(dimension::stress, range::not_negative), "0",
             "Slope of the yield stress by the equivalent plastic strain.", j2},
            {"kinematic_hardening", quantity(dimension::stress, range::not_negative), "0",
             "Slope of the back stress by the equivalent plastic strain.", j2}},
           prony_branch_keys(viscous, viscous),
           {temperature_shift_row(
               "How the times of all branches depend on the temperature; needs loads.start_temperature.", viscous)},
           {{"driven_by", choice("driving energy", {"equilibrium", "stored"}), "\"equilibrium\"",
             "Energy that drives damage: of the relaxed elasticity, or all that is stored, also in the branches.",
             viscous},
            {"volumetric", choice("volumetric energy", {"quadratic", "logarithmic"}), "\"quadratic\"",
             "Energy of the volume change of a hyperelastic material.", volumetric},
            {"second_invariant", number(range::fraction), "",
             "Share of the shear modulus that goes with the second invariant I2 (Mooney-Rivlin).", "mooney_rivlin"},
            {"exponents", list(number()), "", "Exponents alpha of the terms of a hyperelastic material.", powers},
            {"shares", list(number()), "", "Share of the shear modulus of each term; they sum to 1.", powers}}}),
      .decided_by = "law",
      .decided_by_reader = true};
  return table;
}

const KeyTable& elastic_material_keys() {
  static const KeyTable table{
      .name = "materials.NAME, elastic",
      .sentence = "A material of a body in which only interfaces break.",
      .keys = keys::joined({{regions_row()}, rows_of(std::span(quantities).first(n_elastic)), anisotropy_rows()})};
  return table;
}

const KeyTable& composite_material_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "materials.NAME of a composite",
      .sentence = "A material of a composite whose effective stiffness is computed.",
      .keys = joined({elastic_material_keys().keys,
                      {{"density", quantity(dimension::density, range::positive), "none",
                        "Mass density; the composite's needs that of every material."},
                       {"loss_factor", number(range::not_negative), "0",
                        "Loss factor: dissipated energy of a cycle over 2 pi times the largest stored one."}}})};
  return table;
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
  for (const Quantity& quantity : quantities)
    if (const auto value = table.find(quantity.key)) keys.*quantity.value = read_parameter(*value);
  if (const auto value = table.find("damageable")) keys.damageable = value->boolean();
  if (const auto value = table.find("split")) keys.split = read_split(*value);
  if (const auto value = table.find("degradation")) keys.degradation = read_degradation(*value);
  if (const auto value = table.find("fatigue")) keys.fatigue = read_fatigue(*value);
  if (const auto value = table.find("expansion")) keys.expansion = read_expansion(*value);
  if (const auto value = table.find("elasticity")) read_stiffness(table, *value, keys);
  if (const auto value = table.find("axes")) keys.axes = read_axes(*value);
  if (const auto value = table.find("eigenstrain")) keys.eigenstrain = read_eigenstrain(*value, loads_from_start);
  if (const auto value = table.find("softening")) keys.softening = &choose(*value, softening_laws(), "softening law");
  return keys;
}

MaterialKeys read_elastic_keys(const ConfigTable& table) {
  MaterialKeys keys;
  const auto elasticity = table.find("elasticity");
  if (elasticity)
    read_stiffness(table, *elasticity, keys);
  else
    for (const Quantity& quantity : std::span(quantities).first(n_elastic))
      keys.*quantity.value = read_parameter(table.at(quantity.key));
  if (const auto value = table.find("axes")) keys.axes = read_axes(*value);
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
  override_by(by.fatigue, base.fatigue);
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

Fatigue read_fatigue(const ConfigValue& value) {
  const ConfigTable table = value.table();
  const auto [law, p] = law_of_table(table, fatigue_laws(), "fatigue law");
  return {*law, table.quantity("threshold"), p};
}

}  // namespace pfdm
