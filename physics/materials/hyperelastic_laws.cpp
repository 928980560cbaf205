// The shear parts of the hyperelastic laws (hyperelastic.h).

#include "physics/elasticity/principal.h"
#include "physics/materials/hyperelastic.h"
#include "physics/registry.h"

#include <cmath>

namespace pfdm {
namespace {

using Parameters = HyperelasticParameters;

MandelMatrix one_by_one() { return mandel_identity() * mandel_identity().transpose(); }

double shear_modulus(const Parameters& p) { return p.elasticity.mu; }

ShearEnergy neo_hookean(const Parameters& p, const Tensor& E) { return {.energy = p.elasticity.mu * E.trace()}; }

ShearEnergy mooney_rivlin(const Parameters& p, const Tensor& E) {
  const double mu = p.elasticity.mu, mu_01 = p.second_invariant * mu, t = E.trace();
  const Mandel strain = to_mandel(E);
  return {.energy = (mu - mu_01) * t + mu_01 * (2.0 * t + t * t - strain.squaredNorm()),
          .stress = 2.0 * mu_01 * (t * mandel_identity() - strain),
          .stiffness = 2.0 * mu_01 * (one_by_one() - MandelMatrix::Identity())};
}

// With c_i = 1 + 2 E_i the squared stretches.
ShearEnergy ogden(const Parameters& p, const Tensor& E) {
  const PrincipalAxes axes = principal_axes(E);
  ShearEnergy result;
  PrincipalStress principal;
  for (Index i = 0; i < 3; ++i) {
    const double log_c = std::log1p(2.0 * axes.value[i]);
    for (std::size_t k = 0; k < p.shares.size(); ++k) {
      const double alpha = p.exponents[k], modulus = 2.0 * p.shares[k] * p.elasticity.mu / alpha;
      result.energy += modulus / alpha * std::expm1(0.5 * alpha * log_c);
      principal.stress[i] += modulus * std::expm1((0.5 * alpha - 1.0) * log_c);
      principal.slope(i, i) += modulus * (alpha - 2.0) * std::exp((0.5 * alpha - 2.0) * log_c);
    }
  }
  result.stress =
      to_mandel(symmetric_part(axes.direction * principal.stress.asDiagonal() * axes.direction.transpose()));
  result.stiffness = tangent(axes, principal);
  return result;
}

double ogden_initial_stress(const Parameters& p) {
  double sum = 0.0;
  for (std::size_t k = 0; k < p.shares.size(); ++k) sum += 2.0 * p.shares[k] * p.elasticity.mu / p.exponents[k];
  return sum;
}

ShearEnergy lopez_pamies(const Parameters& p, const Tensor& E) {
  const double log_i = std::log1p(2.0 * E.trace() / 3.0);  // of I1/3
  ShearEnergy result;
  for (std::size_t k = 0; k < p.shares.size(); ++k) {
    const double alpha = p.exponents[k], modulus = p.shares[k] * p.elasticity.mu;
    result.energy += 1.5 * modulus / alpha * std::expm1(alpha * log_i);
    result.stress += modulus * std::expm1((alpha - 1.0) * log_i) * mandel_identity();
    result.stiffness += modulus * (alpha - 1.0) * std::exp((alpha - 2.0) * log_i) / 1.5 * one_by_one();
  }
  return result;
}

double sum_of_shares(const Parameters& p) { return p.shares.empty() ? 0.0 : p.elasticity.mu; }

ShearEnergy saint_venant_kirchhoff(const Parameters& p, const Tensor& E) {
  return {.energy = energy_density(p.elasticity, E),
          .stress = to_mandel(stress(p.elasticity, E)),
          .stiffness = stiffness_matrix(p.elasticity)};
}

constexpr HyperelasticLaw all_hyperelastic[] = {
    {"neo_hookean", shear_modulus, neo_hookean, false},
    {"mooney_rivlin", [](const Parameters& p) { return (1.0 + p.second_invariant) * p.elasticity.mu; }, mooney_rivlin},
    {"ogden", ogden_initial_stress, ogden},
    {"lopez_pamies", sum_of_shares, lopez_pamies},
    {"saint_venant_kirchhoff", [](const Parameters&) { return 0.0; }, saint_venant_kirchhoff, false},
};

constexpr HyperelasticLaw own_law{"of one's own", [](const Parameters& p) { return p.own->initial_stress(); },
                                  [](const Parameters& p, const Tensor& E) { return p.own->at(E); }};

}  // namespace

std::span<const HyperelasticLaw> hyperelastic_laws() { return all_hyperelastic; }

const HyperelasticLaw& hyperelastic_law(std::string_view name) {
  return find_by_name(hyperelastic_laws(), name, "hyperelastic law");
}

const HyperelasticLaw& own_hyperelastic_law() { return own_law; }

}  // namespace pfdm
