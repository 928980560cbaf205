#include "cases/program/fracture/body/body_keys.h"

#include "cases/program/fracture/body/boundary_reader.h"
#include "cases/program/input/config/field_keys.h"
#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/laws/law_keys.h"
#include "physics/damage/crack_geometry.h"
#include "physics/damage/degradation.h"
#include "physics/damage/energy_split.h"
#include "physics/damage/fatigue.h"
#include "physics/damage/softening_law.h"
#include "physics/materials/strength_model.h"

namespace pfdm {
namespace {

constexpr Range above_zero_below_one{0.0, 1.0, true, "above 0 and below 1"};
constexpr Range below_half{0.0, 0.5, false, "between 0 and 0.5"};
constexpr Dimension force_per_volume{"force per volume", "N/m^3", "20 kN/m^3"};
constexpr Dimension energy_per_volume{"energy per volume", "J/m^3", "50 kJ/m^3"};
constexpr Dimension foundation_stiffness{"stiffness per area", "N/m^3", "50 MN/m^3"};

constexpr ParameterWords split_words[] = {
    {"gamma", "How much compression lowers the driving energy, by gamma K/2 tr(eps)^2; sets the compressive strength."},
    {"B", "Friction coefficient of Drucker and Prager's criterion sqrt(J2) + B I1 <= 0."},
};
constexpr ParameterWords degradation_words[] = {
    {"s", "Negative slope of the degradation function at d = 0, small for a nearly elastic rise."},
};

constexpr ParameterWords fatigue_words[] = {
    {"kappa", "How fast the logarithmic law falls; nothing is left from 10^(1/kappa) times the threshold on."},
};

const KeyTable& split_keys() {
  static const KeyTable table{
      .name = "split",
      .sentence = "An energy split with its parameters.",
      .keys = law_keys("energy split", energy_splits(), "Name of the energy split.", split_words),
      .decided_by = "law"};
  return table;
}

const KeyTable& degradation_keys() {
  static const KeyTable table{
      .name = "degradation",
      .sentence = "A degradation function with its parameters.",
      .keys = law_keys("degradation function", degradations(), "Name of the degradation function.", degradation_words),
      .decided_by = "law"};
  return table;
}

const KeyTable& fatigue_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fatigue",
      .sentence = "A fatigue law with its threshold and its parameters.",
      .keys = joined({law_keys("fatigue law", fatigue_laws(), "Name of the fatigue law.", fatigue_words),
                      {{"threshold", quantity(energy_per_volume, range::positive), "",
                        "Accumulated driving energy alpha_T up to which the toughness stays as it is."}}}),
      .decided_by = "law"};
  return table;
}

const KeyTable& delta_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fracture.delta",
      .sentence = "The coefficient delta of the model of strength by its formula for a mesh size.",
      .keys = {{"mesh_size", quantity(dimension::length, range::positive), "",
                "Size of the linear finite elements for which the formula of delta is taken."}}};
  return table;
}

std::vector<std::string> model_names() {
  std::vector<std::string> names = keys::names_of(crack_geometries());
  for (const StrengthLaw& law : strength_laws()) names.emplace_back(law.name);
  return names;
}

const KeyTable& crack_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "initial.cracks[]",
      .sentence = "A plane crack that is there before the first step: between points, or a disc.",
      .keys = {{"points", list(point(), 2), "of a disc none",
                "Two points of a straight crack, or the corners of a plane polygon in order."},
               {"front", direction(), "[0, 0, 1]", "Direction of the crack front, for a crack between two points."},
               {"centre", point(), "of a crack with points none", "Centre of a crack that is a disc."},
               {"normal", direction(), "of a crack with points none", "Normal of a crack that is a disc."},
               {"radius", quantity(dimension::length, range::positive), "of a crack with points none",
                "Radius of a crack that is a disc (penny-shaped)."}}};
  return table;
}

const KeyTable& goodier_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "boundary[].displacement",
      .sentence = "A displacement field with a closed form.",
      .keys = {{"field", one_of("displacement field", displacement_fields()), "",
                "Name of the displacement field that is prescribed on the patch."},
               {"inclusion", text("name of a material"), "", "Material of the sphere.", "goodier"},
               {"matrix", text("name of a material"), "", "Material of the infinite matrix around the sphere.",
                "goodier"},
               {"radius", quantity(dimension::length, range::positive), "", "Radius of the sphere.", "goodier"},
               {"stress", quantity(dimension::stress), "", "Remote tension along z at the end of the load.",
                "goodier"}},
      .decided_by = "field"};
  return table;
}

/// Three components, each a value or "free".
KeyType components(const Dimension& due) {
  using namespace keys;
  return list(either({quantity(due), table(expression_keys), table(field_keys), choice("component", {"free"})}), 3, 3);
}

}  // namespace

KeyType split_type() { return law_type("energy split", energy_splits(), split_keys); }
KeyType fatigue_type() { return keys::table(fatigue_keys); }
KeyType degradation_type() { return law_type("degradation function", degradations(), degradation_keys); }

const KeyTable& fracture_model_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fracture",
      .sentence = "The phase-field model of fracture: crack geometry, degradation, split and length.",
      .keys = {
          {"model", choice("crack geometric function or model of strength", model_names()), "\"AT2\"",
           "Crack geometric function (AT1, AT2, Wu's PF-CZM), or AT1 with strength as a property of its own."},
          {"degradation", degradation_type(), "\"quadratic\"",
           "Degradation function of the stiffness by damage; rational for cohesive cracks."},
          {"softening", one_of("softening law", softening_laws()), "\"linear\"",
           "Softening law of the cohesive phase field, with the degradation rational."},
          {"split", split_type(), "\"volumetric_deviatoric\"",
           "Energy split: which part of the strain energy drives damage, tension or all."},
          {"effective_toughness", choice("effective toughness", {"corrected", "as_given"}), "\"corrected\"",
           "Whether the toughness of thin bands is corrected for neighbours into which the crack's profile extends."},
          {"irreversibility", choice("way of irreversibility", {"bounds", "crack_set", "history"}), "\"bounds\"",
           "How healing is prevented: damage cannot fall, not where it is above 0.95, or the driving energy cannot."},
          {"length", quantity(dimension::length, range::positive), "that of the materials",
           "Phase-field length ell of all materials that give none; cells are at most half as thick."},
          {"stiffness_damage", choice("damage of the stiffness", {"cell", "mean"}), "\"cell\"",
           "Which damage degrades a cell's stiffness: its own, or the mean about it, which frees crack directions."},
          {"residual_stiffness", number(above_zero_below_one), "1e-6",
           "Share k of the stiffness that broken cells keep, g_k = (1 - k) g + k."},
          {"viscosity", quantity(dimension::viscosity, range::not_negative), "0: rate-independent",
           "Viscosity eta of the damage equation, by which cracks grow at a finite rate; needs a duration."},
          {"delta", either({number(range::positive), keys::table(delta_keys)}), "the formula without mesh size",
           "Coefficient delta of the model of strength, or the formula for a mesh size."},
          {"perturbation", number(below_half), "0: none",
           "Largest random change of the cells' toughness, relative, so that damage localises in uniform bodies."},
          {"perturbation_seed", whole(range::seed), "1", "Seed of the random change of the toughness."},
      }};
  return table;
}

const KeyTable& initial_damage_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "initial",
      .sentence = "Cracks and damage that are there before the first step.",
      .keys = {
          {"cracks", tables(crack_keys), "none", "Plane cracks that are there before the first step."},
          {"damage", varying(number(range::fraction)), "0",
           "Initial damage field from 0 to 1, a number or a formula of the place."},
          {"regions", list(text("region"), 1), "all damageable regions", "Regions that have the initial damage."}}};
  return table;
}

const KeyTable& boundary_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "boundary[]",
      .sentence = "A condition on patches of the mesh; patches that no entry names are free.",
      .keys =
          {
              {"patch", text("patch"), "or patches", "Name of the patch of the mesh that the condition is for."},
              {"patches", list(text("patch"), 1), "or patch",
               "Names of the patches of the mesh that the condition is for."},
              {"type", one_of("type of boundary condition", boundary_types()), "\"components\"",
               "Type of the boundary condition: components, symmetry, plane strain, plane stress, axisymmetric, "
               "elastic "
               "foundation, free."},
              {"displacement", either({components(dimension::length), keys::table(goodier_keys)}), "free",
               "Prescribed displacement along x, y, z, each a length, a formula or free; or a field."},
              {"traction", components(dimension::stress), "free",
               "Prescribed traction along x, y, z per reference area, where the displacement is free (dead load)."},
              {"pressure", varying(quantity(dimension::stress)), "none",
               "Pressure that pushes against the patch, negative for suction; follows the body at finite strain."},
              {"normal_stiffness", varying(quantity(foundation_stiffness, range::not_negative)), "0",
               "Stiffness k_n of an elastic foundation along the undeformed normal, traction per displacement.",
               "elastic_foundation"},
              {"tangential_stiffness", varying(quantity(foundation_stiffness, range::not_negative)), "0",
               "Stiffness k_t of an elastic foundation along the undeformed surface, traction per displacement.",
               "elastic_foundation"},
          },
      .decided_by = "type",
      .decided_otherwise = "components"};
  return table;
}

const KeyTable& load_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "loads",
      .sentence = "What acts within the body: gravity, body forces, changes of temperature.",
      .keys = {
          {"gravity", list(varying(quantity(dimension::acceleration)), 3, 3), "none",
           "Acceleration of gravity along x, y, z, which acts on the materials' density."},
          {"body_force", list(varying(quantity(force_per_volume)), 3, 3), "none",
           "Force per reference volume along x, y, z in all regions, such as a centrifugal force."},
          {"temperature_change", varying(quantity(dimension::temperature_difference)), "none",
           "Change of temperature (heating, cooling), a difference in K, by the materials' expansion and "
           "temperature_shift."},
          {"start_temperature", quantity(dimension::temperature, range::positive), "none",
           "Temperature of the body at the start, for materials with a temperature_shift."},
          {"applied", choice("way in which loads are applied", {"with_load", "from_start"}), "\"with_load\"",
           "Whether plain body loads and eigenstrains grow with the load parameter or act from the start."},
      }};
  return table;
}

}  // namespace pfdm
