#include "cases/program/fracture/body/material_laws.h"

#include "cases/program/input/laws/endochronic_reader.h"
#include "cases/program/input/laws/prony_reader.h"
#include "cases/program/input/laws/temperature_shift_reader.h"
#include "physics/materials/endochronic_material.h"
#include "physics/materials/hyperelastic.h"
#include "physics/materials/j2_plasticity.h"
#include "physics/materials/prony.h"

namespace pfdm {
namespace {

IsotropicElasticity read_elasticity(const ConfigTable& material) {
  return from_young_poisson(material.quantity("young_modulus"), material.number("poisson_ratio"));
}

constexpr MaterialLaw linear_elastic{
    .name = "linear_elastic",
    .description = "isotropic, small strain",
    .read = [](const ConfigTable&) { return std::shared_ptr<const Material>(); },
};

constexpr MaterialLaw endochronic{
    .name = "endochronic",
    .description = "plasticity without a yield surface (Valanis 1971); kernel, hardening, rate, beta",
    .read = [](const ConfigTable& material) { return make_endochronic_material(read_endochronic_law(material)); },
};

constexpr MaterialLaw j2_plasticity{
    .name = "j2_plasticity",
    .description = "von Mises plasticity with linear isotropic and kinematic hardening",
    .read =
        [](const ConfigTable& material) {
          return make_j2_plasticity(read_elasticity(material),
                                    {.yield_stress = material.quantity("yield_stress"),
                                     .isotropic_hardening = material.quantity("isotropic_hardening", 0.0),
                                     .kinematic_hardening = material.quantity("kinematic_hardening", 0.0)});
        },
};

PronyDrive read_drive(const ConfigTable& material) {
  return material.choice("driven_by", "equilibrium") == "stored" ? PronyDrive::stored : PronyDrive::equilibrium;
}

constexpr MaterialLaw prony{
    .name = "prony",
    .description =
        "linear viscoelasticity, a generalised Maxwell body; shear_branches, bulk_branches, driven_by, "
        "temperature_shift",
    .read =
        [](const ConfigTable& material) {
          PronyLaw law = read_prony_series(material);
          law.drive = read_drive(material);
          law.shift = read_temperature_shift(material);
          return make_prony(law);
        },
};

HyperelasticParameters read_volumetric(const ConfigTable& material) {
  HyperelasticParameters p{.elasticity = read_elasticity(material),
                           .branches = read_shear_branches(material),
                           .bulk_branches = read_bulk_branches(material),
                           .drive = read_drive(material),
                           .shift = read_temperature_shift(material)};
  if (material.choice("volumetric", "quadratic") == "logarithmic") p.volumetric = VolumetricForm::logarithmic;
  return p;
}

HyperelasticParameters read_powers(const ConfigTable& material) {
  HyperelasticParameters p = read_volumetric(material);
  for (const ConfigValue& entry : material.at("exponents").list()) p.exponents.push_back(entry.number());
  for (const ConfigValue& entry : material.at("shares").list()) p.shares.push_back(entry.number());
  return p;
}

std::shared_ptr<const Material> make(const ConfigTable& material, std::string_view law,
                                     const HyperelasticParameters& p) {
  return material.at("law").in_context([&] { return make_hyperelastic(law, p); });
}

constexpr MaterialLaw neo_hookean{
    .name = "neo_hookean",
    .description = "finite strain: mu/2 (I1 - 3) - mu ln J + U(J); volumetric, shear_branches, driven_by",
    .read = [](const ConfigTable& m) { return make(m, "neo_hookean", read_volumetric(m)); },
};

constexpr MaterialLaw mooney_rivlin{
    .name = "mooney_rivlin",
    .description = "finite strain: terms in I1 and I2; second_invariant, volumetric, shear_branches, driven_by",
    .read =
        [](const ConfigTable& m) {
          HyperelasticParameters p = read_volumetric(m);
          p.second_invariant = m.number("second_invariant");
          return make(m, "mooney_rivlin", p);
        },
};

constexpr MaterialLaw ogden{
    .name = "ogden",
    .description =
        "finite strain: powers of the principal stretches (Ogden 1972); exponents, shares, volumetric, shear_branches",
    .read = [](const ConfigTable& m) { return make(m, "ogden", read_powers(m)); },
};

constexpr MaterialLaw lopez_pamies{
    .name = "lopez_pamies",
    .description = "finite strain: powers of I1 (Lopez-Pamies 2010); exponents, shares, volumetric, shear_branches",
    .read = [](const ConfigTable& m) { return make(m, "lopez_pamies", read_powers(m)); },
};

constexpr MaterialLaw saint_venant_kirchhoff{
    .name = "saint_venant_kirchhoff",
    .description = "large rotations of small strains: linear in Green's strain",
    .read = [](const ConfigTable& m) { return make(m, "saint_venant_kirchhoff", {.elasticity = read_elasticity(m)}); },
};

constexpr MaterialLaw all_material_laws[] = {linear_elastic, endochronic,  j2_plasticity,
                                             prony,          neo_hookean,  mooney_rivlin,
                                             ogden,          lopez_pamies, saint_venant_kirchhoff};

}  // namespace

std::span<const MaterialLaw> material_laws() { return all_material_laws; }

const MaterialLaw& law_of_material(const ConfigTable& material) {
  if (const auto law = material.find("law")) return choose(*law, material_laws(), "law of a material");
  return material.has("kernel") ? endochronic : linear_elastic;
}

}  // namespace pfdm
