// Static condensation across a plate: no stress across it, and the stress and energy within it.

#include "physics/elasticity/plane_stress.h"

#include "physics/damage/energy_split.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

constexpr double E = 20e9;

// A strain within the plate of normal z.
Mandel within_plate(RandomTensors& random) {
  Tensor eps = random.symmetric(1e-3);
  eps.row(2).setZero();
  eps.col(2).setZero();
  return to_mandel(eps);
}

TEST(PlaneStress, TensionHasYoungsModulusAndPoissonsRatio) {
  for (const double nu : {-0.3, 0.0, 0.18, 0.49}) {
    const IsotropicElasticity c = plane_stress(from_young_poisson(E, nu));
    const Tensor sigma = stress(c, Vector(1e-3, -nu * 1e-3, 0.0).asDiagonal());
    EXPECT_NEAR(sigma(0, 0), E * 1e-3, 1e-9 * E * 1e-3);
    EXPECT_NEAR(sigma(1, 1), 0.0, 1e-9 * E * 1e-3);
  }
}

// Those with which plane strain is plane stress in E and nu.
TEST(PlaneStress, ModuliAreThoseOfTheTextbook) {
  for (const double nu : {-0.3, 0.0, 0.18, 0.49}) {
    const IsotropicElasticity c = plane_stress(from_young_poisson(E, nu));
    EXPECT_NEAR(c.young_modulus(), E * (1.0 + 2.0 * nu) / std::pow(1.0 + nu, 2), 1e-9 * E);
    EXPECT_NEAR(c.poisson_ratio(), nu / (1.0 + nu), 1e-9);
  }
}

TEST(PlaneStress, OfModuliIsThatOfTheirStiffness) {
  RandomTensors random;
  const IsotropicElasticity c = from_young_poisson(E, 0.3);
  const LinearStress full = plane_stress({.C = stiffness_matrix(c), .initial = Mandel::Zero()}, Vector::UnitZ());
  for (int i = 0; i < 10; ++i) {
    const Mandel eps = within_plate(random);
    Mandel expected = to_mandel(stress(plane_stress(c), to_tensor(eps)));
    expected[2] = 0.0;
    EXPECT_LE((full(eps) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_NEAR(energy_density(plane_stress(c), to_tensor(eps)), 0.5 * full(eps).dot(eps), 1e-12 * full(eps).dot(eps));
  }
}

// Of any stiffness with an initial stress, in a plate that is turned: with the strain across it, the material's own
// stress is that within the plate.
TEST(PlaneStress, TheStrainAcrossLeavesNoStressThere) {
  RandomTensors random;
  const Tensor R = random.rotation();
  const auto turned = [&](const Mandel& v) { return to_mandel(R * to_tensor(v) * R.transpose()); };
  const Vector n = R.col(2);
  for (const SplitLaw& law : energy_splits())
    for (int i = 0; i < 10; ++i) {
      const IsotropicElasticity c = from_young_poisson(E, 0.3);
      const Mandel history = turned(within_plate(random) + 3e-4 * Mandel::Unit(2));
      const LinearStress material{.C = degraded_tangent(EnergySplit(law, {2.0}), c, 0.1, to_tensor(history)),
                                  .initial = 1e9 * history};
      const Mandel eps = turned(within_plate(random));
      const Mandel across = strain_across(material, n)(eps) * to_mandel(n * n.transpose());
      const Mandel sigma = material(eps + across);
      EXPECT_LE((to_tensor(sigma) * n).norm(), 1e-9 * sigma.norm()) << law.name;
      EXPECT_LE((plane_stress(material, n)(eps) - sigma).norm(), 1e-9 * sigma.norm()) << law.name;
    }
}

}  // namespace
}  // namespace pfdm::this_file
