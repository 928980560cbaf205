#include "cases/program/fracture/body/region_model.h"

#include "physics/elasticity/anisotropy.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

namespace pfdm {
namespace {

// Strength and toughness make the coefficients of the degradation.
RationalCoefficients make_coefficients(std::optional<double> strength, const RegionModel& model,
                                       const std::string& region, const SofteningLaw& law, const ConfigTable& table) {
  if (!strength)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no strength (ft), which the softening law "
                    "\"{}\" needs; give strength, as in \"{}\", or damageable = false",
                    region, law.name, dimension::stress.example));
  const double E = model.elasticity.young_modulus(), longest = longest_length(law, E, model.Gc, *strength);
  if (model.ell > longest)
    throw table.error(
        fmt::format("region \"{}\": the length (ell) is {}; with this strength and toughness the \"{}\" law needs one "
                    "of at most {}",
                    region, quantity_text(model.ell, "m"), law.name, quantity_text(longest, "m")));
  return rational_coefficients(law, E, model.Gc, *strength, model.ell);
}

double hydrostatic_strength_of(const MaterialKeys& keys, const std::string& region, const ConfigTable& table,
                               const Vector& x) {
  if (keys.hydrostatic_strength.has_value() == keys.compressive_strength.has_value())
    throw table.error(
        fmt::format("region \"{}\": expected either hydrostatic_strength or compressive_strength, which the model of "
                    "strength needs, as in \"{}\"",
                    region, dimension::stress.example));
  if (keys.hydrostatic_strength) return keys.hydrostatic_strength->at(x);
  return table.in_context([&] { return hydrostatic_strength(keys.strength->at(x), keys.compressive_strength->at(x)); });
}

StrengthModel make_strength(const MaterialKeys& keys, const RegionModel& model, const std::string& region,
                            const StrengthChoice& choice, const ConfigTable& table, const Vector& x) {
  const bool is_elastic = !keys.material || keys.material->is_finite_strain();
  if (!is_elastic || (keys.degradation && keys.degradation->name() != "quadratic"))
    throw table.error(fmt::format(
        "region \"{}\": the model of strength requires the degradation \"quadratic\" and a linear elastic or "
        "hyperelastic material",
        region));
  if (!keys.strength)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no strength (in uniaxial tension), which the "
                    "model of strength needs, as in \"{}\"",
                    region, dimension::stress.example));
  const StrengthData data{.elasticity = model.elasticity,
                          .tensile = keys.strength->at(x),
                          .hydrostatic = hydrostatic_strength_of(keys, region, table, x),
                          .Gc = model.Gc,
                          .ell = model.ell,
                          .material = keys.material};
  return table.in_context([&] {
    const double delta = choice.delta ? *choice.delta : choice.law->delta(data, choice.mesh_size);
    return StrengthModel(*choice.law, data, delta);
  });
}

// What depends on the direction, in the frame of the mesh.
void turn(const MaterialKeys& keys, const ConfigTable& table, const Vector& x, RegionModel& model) {
  if (keys.axes && !keys.stiffness && !keys.expansion)
    throw table.error("axes turn an elasticity that depends on the direction, or an expansion; neither is given");
  const Tensor axes = keys.axes ? keys.axes->at(x) : Tensor::Identity();
  if (keys.stiffness)
    model.stiffness = keys.axes ? std::make_shared<const MandelMatrix>(turned(*keys.stiffness, axes)) : keys.stiffness;
  if (!keys.expansion) return;
  Vector along;
  for (std::size_t i = 0; i < 3; ++i) along[i] = (*keys.expansion)[i].at(x);
  const bool is_uniform = along[0] == along[1] && along[1] == along[2];  // without rounding by the axes
  model.expansion =
      keys.axes && !is_uniform ? Tensor(axes * along.asDiagonal() * axes.transpose()) : Tensor(along.asDiagonal());
}

}  // namespace

RegionModel region_model(const MaterialKeys& keys, const std::string& region, const MaterialDefaults& defaults,
                         const ConfigTable& table, const Vector& x) {
  RegionModel model;
  model.elasticity = from_young_poisson(keys.young_modulus->at(x), keys.poisson_ratio->at(x));
  model.material = keys.material;
  if (model.material && !model.material->is_finite_strain()) model.elasticity = model.material->elasticity();
  model.split = keys.split.value_or(EnergySplit());
  model.density = value_at(keys.density, x).value_or(0.0);
  model.conductivity = value_at(keys.conductivity, x).value_or(0.0);
  model.specific_heat = value_at(keys.specific_heat, x).value_or(0.0);
  turn(keys, table, x, model);
  model.eigenstrain = keys.eigenstrain;
  model.damageable = keys.damageable.value_or(true);
  model.Gc = value_at(keys.toughness, x).value_or(0.0);
  model.ell = value_at(keys.length, x).value_or(defaults.ell.value_or(0.0));
  if (!model.damageable) {
    // Of the material itself; a region of it may be undamageable.
    if (keys.fatigue && !table.boolean("damageable", true))
      throw table.at("fatigue").error(
          "this belongs to a material that can be damaged; leave it out, or damageable = false");
    return model;
  }
  if (!keys.toughness)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no toughness (Gc); give toughness, as in "
                    "\"{}\", or damageable = false",
                    region, dimension::toughness.example));
  if (model.ell == 0.0)
    throw table.error(
        fmt::format("region \"{}\" can be damaged but has no length (ell); give it in [fracture] or "
                    "here, as in \"10 um\"",
                    region));
  if (defaults.strength.law != nullptr)
    model.strength = make_strength(keys, model, region, defaults.strength, table, x);
  model.fatigue = keys.fatigue.value_or(Fatigue());
  if (keys.degradation) model.degradation = *keys.degradation;
  if (!keys.degradation.value_or(defaults.degradation).law().needs_strength) return model;
  const SofteningLaw* const given = keys.softening.value_or(defaults.softening);
  const SofteningLaw& softening = given != nullptr ? *given : softening_law("linear");
  model.degradation =
      rational_degradation(make_coefficients(value_at(keys.strength, x), model, region, softening, table));
  return model;
}

}  // namespace pfdm
