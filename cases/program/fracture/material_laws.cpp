#include "cases/program/fracture/material_laws.h"

#include "cases/program/point/endochronic_material.h"
#include "physics/materials/endochronic_material.h"
#include "physics/materials/j2_plasticity.h"

namespace pfdm {
namespace {

IsotropicElasticity read_elasticity(const ConfigTable& material) {
  return from_young_poisson(material.quantity("young_modulus", dimension::stress, range::positive),
                            material.number("poisson_ratio", range::poisson_ratio));
}

constexpr MaterialLaw linear_elastic{
    .name = "linear_elastic",
    .description = "isotropic, small strain",
    .keys = {},
    .read = [](const ConfigTable&) { return std::shared_ptr<const Material>(); },
};

constexpr std::string_view endochronic_keys[] = {"hardening", "rate", "beta"};
constexpr MaterialLaw endochronic{
    .name = "endochronic",
    .description = "plasticity without a yield surface (Valanis 1971); kernel, hardening, rate, beta",
    .keys = endochronic_keys,
    .read = [](const ConfigTable& material) { return make_endochronic_material(read_endochronic_law(material)); },
};

constexpr std::string_view j2_keys[] = {"yield_stress", "isotropic_hardening", "kinematic_hardening"};
constexpr MaterialLaw j2_plasticity{
    .name = "j2_plasticity",
    .description = "von Mises plasticity with linear isotropic and kinematic hardening",
    .keys = j2_keys,
    .read =
        [](const ConfigTable& material) {
          const auto stress = [&](std::string_view key, double otherwise) {
            return material.quantity(key, dimension::stress, range::not_negative, otherwise);
          };
          return make_j2_plasticity(
              read_elasticity(material),
              {.yield_stress = material.quantity("yield_stress", dimension::stress, range::positive),
               .isotropic_hardening = stress("isotropic_hardening", 0.0),
               .kinematic_hardening = stress("kinematic_hardening", 0.0)});
        },
};

constexpr MaterialLaw table[] = {linear_elastic, endochronic, j2_plasticity};

}  // namespace

std::span<const MaterialLaw> material_laws() { return table; }

const MaterialLaw& law_of_material(const ConfigTable& material) {
  if (const auto law = material.find("law")) return choose(*law, material_laws(), "law of a material");
  return material.has("kernel") ? endochronic : linear_elastic;
}

}  // namespace pfdm
