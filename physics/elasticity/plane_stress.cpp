#include "physics/elasticity/plane_stress.h"

namespace pfdm {
namespace {

Mandel direction(const Vector& n) { return to_mandel(n * n.transpose()); }

}  // namespace

StrainAcross strain_across(const LinearStress& material, const Vector& n) {
  const Mandel nn = direction(n);
  const double stiffness = nn.dot(material.C * nn);
  return {.of_strain = -(material.C.transpose() * nn) / stiffness, .initial = -nn.dot(material.initial) / stiffness};
}

LinearStress plane_stress(const LinearStress& material, const Vector& n) {
  const StrainAcross across = strain_across(material, n);
  const Mandel of_across = material.C * direction(n);
  return {.C = material.C + of_across * across.of_strain.transpose(),
          .initial = material.initial + across.initial * of_across};
}

IsotropicElasticity plane_stress(const IsotropicElasticity& c) {
  return {.lambda = 2.0 * c.lambda * c.mu / c.constrained_modulus(), .mu = c.mu};
}

}  // namespace pfdm
