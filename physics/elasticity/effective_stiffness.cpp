#include "physics/elasticity/effective_stiffness.h"

#include <algorithm>

namespace pfdm {
namespace {

struct Moduli {
  double K, G;
};

// Projections of a stiffness or of a compliance on its isotropic parts: 3K and 2G, or their inverses.
Moduli projections(const MandelMatrix& C) {
  return {C.cwiseProduct(volumetric_projector()).sum(), C.cwiseProduct(deviatoric_projector()).sum() / 5.0};
}

IsotropicElasticity from_bulk_shear(const Moduli& m) { return {.lambda = m.K - 2.0 * m.G / 3.0, .mu = m.G}; }

// (sum c / (m_i + shift))^-1 - shift
template <class Modulus>
double shifted_harmonic_mean(std::span<const Phase> phases, double shift, const Modulus& modulus) {
  double sum = 0.0;
  for (const Phase& phase : phases) sum += phase.fraction / (modulus(phase.elasticity) + shift);
  return 1.0 / sum - shift;
}

double bulk(const IsotropicElasticity& c) { return c.bulk_modulus(); }
double shear(const IsotropicElasticity& c) { return c.mu; }

Moduli with_reference(std::span<const Phase> phases, const Moduli& reference) {
  const auto [K, G] = reference;
  return {shifted_harmonic_mean(phases, 4.0 / 3.0 * G, bulk),
          shifted_harmonic_mean(phases, G / 6.0 * (9.0 * K + 8.0 * G) / (K + 2.0 * G), shear)};
}

}  // namespace

IsotropicElasticity closest_isotropic(const MandelMatrix& C) {
  const Moduli m = projections(C);
  return from_bulk_shear({m.K / 3.0, 0.5 * m.G});
}

double anisotropy(const MandelMatrix& C) { return (C - stiffness_matrix(closest_isotropic(C))).norm() / C.norm(); }

double universal_anisotropy(const MandelMatrix& C) {
  const Moduli voigt = projections(C), reuss = projections(C.inverse());
  return 5.0 * voigt.G * reuss.G + voigt.K * reuss.K - 6.0;
}

double asymmetry(const MandelMatrix& C) { return (C - C.transpose()).norm() / C.norm(); }

MandelMatrix voigt_stiffness(const MandelMatrix& C) {
  MandelMatrix V = C;
  for (int i = 0; i < n_components; ++i)
    for (int j = 0; j < n_components; ++j) V(i, j) /= mandel_factor(i) * mandel_factor(j);
  return V;
}

MandelMatrix voigt_compliance(const MandelMatrix& C) { return voigt_stiffness(C).inverse(); }

ModulusBounds reuss_voigt(std::span<const Phase> phases) {
  ModulusBounds bounds{.bulk_lower = shifted_harmonic_mean(phases, 0.0, bulk),
                       .shear_lower = shifted_harmonic_mean(phases, 0.0, shear)};
  for (const Phase& phase : phases) {
    bounds.bulk_upper += phase.fraction * bulk(phase.elasticity);
    bounds.shear_upper += phase.fraction * shear(phase.elasticity);
  }
  return bounds;
}

ModulusBounds hashin_shtrikman(std::span<const Phase> phases) {
  Moduli least{bulk(phases[0].elasticity), shear(phases[0].elasticity)}, most = least;
  for (const Phase& phase : phases) {
    least = {std::min(least.K, bulk(phase.elasticity)), std::min(least.G, shear(phase.elasticity))};
    most = {std::max(most.K, bulk(phase.elasticity)), std::max(most.G, shear(phase.elasticity))};
  }
  const Moduli lower = with_reference(phases, least), upper = with_reference(phases, most);
  return {.bulk_lower = lower.K, .bulk_upper = upper.K, .shear_lower = lower.G, .shear_upper = upper.G};
}

}  // namespace pfdm
