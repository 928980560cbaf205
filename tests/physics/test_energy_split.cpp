#include "physics/energy_split.h"
#include "physics/error.h"
#include "tests/physics/physics_checks.h"

namespace pfdm {
namespace {

// Random strains of both signs of the trace, for one split after the other.
void for_splits_and_strains(const std::function<void(const EnergySplit&, const Tensor& eps)>& check,
                            bool variational_only = false) {
  for (const EnergySplit& split : energy_splits()) {
    if (variational_only && !split.variational) continue;
    SCOPED_TRACE(split.name);
    RandomTensors random;
    int expanding = 0, compressed = 0;
    for (int i = 0; i < 20; ++i) {
      const Tensor eps = random.symmetric(1e-2);
      ++(eps.trace() > 0.0 ? expanding : compressed);
      check(split, eps);
    }
    EXPECT_GT(expanding, 4);
    EXPECT_GT(compressed, 4);
  }
}

const IsotropicElasticity glass = from_young_poisson(70e9, 0.3);

TEST(EnergySplit, PartsAreNotNegativeAndAddUp) {
  for_splits_and_strains([](const EnergySplit& split, const Tensor& eps) {
    const auto [plus, minus] = split.energy(glass, eps);
    EXPECT_GE(plus, 0.0);
    EXPECT_GE(minus, 0.0);
    if (split.variational) {
      EXPECT_NEAR(plus + minus, energy_density(glass, eps), 1e-12 * energy_density(glass, eps));
    }
  });
}

TEST(EnergySplit, SecantStressIsTheSlopeOfTheDegradedEnergy) {
  for (const double g : {1.0, 0.3, 1e-6})
    for_splits_and_strains(
        [g](const EnergySplit& split, const Tensor& eps) {
          const auto degraded = [&](const Tensor& e) {
            const auto [plus, minus] = split.energy(glass, e);
            return g * plus + minus;
          };
          const Tensor expected = slope(degraded, eps, 1e-6);
          const Tensor sigma = stress(split.secant(glass, g, split.closure(eps)), eps);
          EXPECT_LE((sigma - expected).norm(), 1e-7 * stress(glass, eps).norm()) << "g = " << g;
        },
        true);
}

TEST(EnergySplit, SecantEnergyIsTheDegradedEnergy) {
  for_splits_and_strains(
      [](const EnergySplit& split, const Tensor& eps) {
        constexpr double g = 0.3;
        const auto [plus, minus] = split.energy(glass, eps);
        EXPECT_NEAR(energy_density(split.secant(glass, g, split.closure(eps)), eps), g * plus + minus,
                    1e-12 * (plus + minus));
      },
      true);
}

TEST(EnergySplit, UndamagedSecantDoesNotDependOnTheClosure) {
  for (const EnergySplit& split : energy_splits())
    for (const double closure : {0.0, 0.5, 1.0}) {
      EXPECT_NEAR(split.secant(glass, 1.0, closure).lambda, glass.lambda, 1e-12 * glass.lambda) << split.name;
      EXPECT_NEAR(split.secant(glass, 1.0, closure).mu, glass.mu, 1e-12 * glass.mu) << split.name;
    }
}

TEST(EnergySplit, DoesNotDependOnTheAxes) {
  RandomTensors rotations;
  for_splits_and_strains([&](const EnergySplit& split, const Tensor& eps) {
    const Tensor R = rotations.rotation();
    const Tensor turned = R * eps * R.transpose();
    const double psi = energy_density(glass, eps);
    EXPECT_NEAR(split.energy(glass, turned).psi_plus, split.energy(glass, eps).psi_plus, 1e-12 * psi);
    const Tensor sigma = stress(split.secant(glass, 0.3, split.closure(eps)), eps);
    const Tensor sigma_turned = stress(split.secant(glass, 0.3, split.closure(turned)), turned);
    EXPECT_LE((sigma_turned - R * sigma * R.transpose()).norm(), 1e-12 * sigma.norm());
  });
}

TEST(EnergySplit, VolumetricDeviatoricKeepsCompressionAlone) {
  const EnergySplit& split = energy_split("volumetric_deviatoric");
  const Tensor compression = -1e-3 * Tensor::Identity();
  EXPECT_NEAR(split.energy(glass, compression).psi_plus, 0.0, 1e-20);
  EXPECT_LE(
      (stress(split.secant(glass, 1e-6, split.closure(compression)), compression) - stress(glass, compression)).norm(),
      1e-3);
  Tensor shear = Tensor::Zero();
  shear(0, 1) = shear(1, 0) = 1e-3;
  EXPECT_EQ(split.energy(glass, shear).psi_minus, 0.0);
}

// Uniaxial stress: the driving energy is the whole one in tension, none in compression, whatever nu.
TEST(EnergySplit, RankineIsDrivenByTheLargestPrincipalStress) {
  const EnergySplit& split = energy_split("rankine");
  const double E = glass.young_modulus(), nu = glass.poisson_ratio(), sigma = 40e6;
  const Tensor R = RandomTensors().rotation();
  const Tensor tension = R * Tensor(Vector(sigma / E, -nu * sigma / E, -nu * sigma / E).asDiagonal()) * R.transpose();
  EXPECT_NEAR(split.energy(glass, tension).psi_plus, energy_density(glass, tension), 1e-10 * sigma * sigma / E);
  EXPECT_NEAR(split.energy(glass, -tension).psi_plus, 0.0, 1e-12 * sigma * sigma / E);
  const Tensor hydrostatic = sigma * (1.0 - 2.0 * nu) / E * Tensor::Identity();
  EXPECT_NEAR(split.energy(glass, hydrostatic).psi_plus, 0.5 * sigma * sigma / E, 1e-10 * sigma * sigma / E);
}

TEST(EnergySplit, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(energy_splits(), energy_split);
}

}  // namespace
}  // namespace pfdm
