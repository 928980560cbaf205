// Energy splits where the elasticity depends on the direction: derivatives, orthogonality, the isotropic limit, turned
// axes, and what is kept of simple strains. The oracles are written from the definitions, by Eigen's square root.

#include "physics/damage/energy_split.h"
#include "tests/physics/physics_checks.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pfdm::this_file {
namespace {

const IsotropicElasticity glass = from_young_poisson(70e9, 0.3);

MandelMatrix carbon() {
  return turned(orthotropic_stiffness({140e9, 10e9, 9e9, 0.3, 0.28, 0.45, 5e9, 4.5e9, 3.4e9}),
                RandomTensors().rotation());
}

std::vector<EnergySplit> splits() {
  std::vector<EnergySplit> suited;
  for (const SplitLaw& law : energy_splits())
    if (law.kept_of != nullptr) suited.emplace_back(law);
  return suited;
}

void for_splits_and_strains(const std::function<void(const EnergySplit&, const Tensor& eps)>& check) {
  for (const EnergySplit& split : splits()) {
    SCOPED_TRACE(split.name());
    RandomTensors random;
    for (int i = 0; i < 20; ++i) check(split, random.symmetric(1e-2));
  }
}

double whole_energy(const MandelMatrix& C, const Tensor& eps) { return 0.5 * to_mandel(eps).dot(C * to_mandel(eps)); }

TEST(AnisotropicSplits, TheRootIsThatOfTheStiffness) {
  for (const MandelMatrix& C : {carbon(), cubic_stiffness(165e9, 64e9, 79e9), stiffness_matrix(glass)}) {
    const AnisotropicElasticity c = anisotropic_elasticity(C);
    EXPECT_LE((c.root * c.root - C).norm(), 1e-14 * C.norm());
    EXPECT_LE((c.root - Eigen::SelfAdjointEigenSolver<MandelMatrix>(C).operatorSqrt()).norm(), 1e-13 * c.root.norm());
  }
  EXPECT_NEAR(anisotropic_elasticity(stiffness_matrix(glass)).bulk_modulus, glass.bulk_modulus(), 1e-3);
}

TEST(AnisotropicSplits, PartsAreNotNegativeAndAddUp) {
  const AnisotropicElasticity c = anisotropic_elasticity(carbon());
  for_splits_and_strains([&](const EnergySplit& split, const Tensor& eps) {
    const auto [plus, minus] = energy(split, c, eps);
    const double whole = whole_energy(c.stiffness, eps);
    EXPECT_GE(plus, 0.0);
    EXPECT_GE(minus, 0.0);
    EXPECT_NEAR(plus + minus, whole, 1e-12 * whole);
  });
}

TEST(AnisotropicSplits, StressAndTangentAreSlopesOfTheDegradedEnergy) {
  const AnisotropicElasticity c = anisotropic_elasticity(carbon());
  for (const double g : {0.3, 1e-6})
    for_splits_and_strains([&](const EnergySplit& split, const Tensor& eps) {
      const auto degraded = [&](const Tensor& e) {
        const auto [plus, minus] = energy(split, c, e);
        return g * plus + minus;
      };
      const auto stress_at = [&](const Tensor& e) -> Mandel { return degraded_tangent(split, c, g, e) * to_mandel(e); };
      const double size = (c.stiffness * to_mandel(eps)).norm();
      EXPECT_LE((to_tensor(stress_at(eps)) - slope(degraded, eps, 1e-6)).norm(), 1e-6 * size) << "g = " << g;
      EXPECT_LE((degradable_stress(split, c, eps) -
                 slope([&](const Tensor& e) { return energy(split, c, e).psi_plus; }, eps, 1e-6))
                    .norm(),
                1e-6 * size);
      const MandelMatrix tangent = degraded_tangent(split, c, g, eps);
      for (Index k = 0; k < 6; ++k) {
        const Tensor change = to_tensor(1e-8 * Mandel::Unit(k));
        const Mandel difference = (stress_at(eps + change) - stress_at(eps - change)) / 2e-8;
        EXPECT_LE((difference - tangent.col(k)).norm(), 1e-6 * c.stiffness.norm());
      }
    });
}

TEST(AnisotropicSplits, IsotropicConstantsGiveTheIsotropicSplit) {
  const AnisotropicElasticity c = anisotropic_elasticity(stiffness_matrix(glass));
  for_splits_and_strains([&](const EnergySplit& split, const Tensor& eps) {
    const double whole = energy_density(glass, eps);
    EXPECT_NEAR(energy(split, c, eps).psi_plus, split.energy(glass, eps).psi_plus, 1e-12 * whole);
    EXPECT_LE((degraded_tangent(split, c, 0.3, eps) - degraded_tangent(split, glass, 0.3, eps)).norm(),
              1e-10 * c.stiffness.norm());
  });
}

TEST(AnisotropicSplits, TurnWithTheMaterial) {
  RandomTensors rotations;
  for_splits_and_strains([&](const EnergySplit& split, const Tensor& eps) {
    const Tensor R = rotations.rotation();
    const double here = energy(split, anisotropic_elasticity(carbon()), eps).psi_plus;
    const double there = energy(split, anisotropic_elasticity(turned(carbon(), R)), R * eps * R.transpose()).psi_plus;
    EXPECT_NEAR(here, there, 1e-11 * whole_energy(carbon(), eps));
  });
}

// By the definition: the strains e+- = C^(-1/2) (C^(1/2) eps)+- are orthogonal, e+ : C : e- = 0, and the stress is
// C : (g e+ + e-).
TEST(AnisotropicSplits, OrthogonalStrainsAreOrthogonal) {
  const MandelMatrix C = carbon();
  const Eigen::SelfAdjointEigenSolver<MandelMatrix> solver(C);
  const MandelMatrix root = solver.operatorSqrt(), inverse = solver.operatorInverseSqrt();
  RandomTensors random;
  for (int i = 0; i < 20; ++i) {
    const Tensor eps = random.symmetric(1e-2);
    const Eigen::SelfAdjointEigenSolver<Tensor> axes(to_tensor(root * to_mandel(eps)));
    const Tensor positive =
        axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).asDiagonal() * axes.eigenvectors().transpose();
    const Mandel e_plus = inverse * to_mandel(positive), e_minus = to_mandel(eps) - e_plus;
    EXPECT_LE(std::abs(e_plus.dot(C * e_minus)), 1e-10 * whole_energy(C, eps));
    constexpr double g = 0.2;
    const Mandel stress = C * (g * e_plus + e_minus);
    const Mandel found =
        degraded_tangent(energy_split("orthogonal"), anisotropic_elasticity(C), g, eps) * to_mandel(eps);
    EXPECT_LE((found - stress).norm(), 1e-10 * stress.norm());
  }
}

// A pressure on all sides is kept whole, though the strain is not the same in all directions.
TEST(AnisotropicSplits, PressureIsKeptWhole) {
  const MandelMatrix C = carbon();
  const Tensor pressed = to_tensor(-(C.inverse() * mandel_identity()));
  const EnergySplit split = energy_split("volumetric_deviatoric");
  const double whole = whole_energy(C, pressed);
  EXPECT_NEAR(energy(split, anisotropic_elasticity(C), pressed).psi_minus, whole, 1e-12 * whole);
  EXPECT_NEAR(energy(split, anisotropic_elasticity(C), -pressed).psi_plus, whole, 1e-12 * whole);
}

TEST(AnisotropicSplits, AreNamed) { EXPECT_EQ(splits_for_anisotropy(), "none, volumetric_deviatoric, orthogonal"); }

}  // namespace
}  // namespace pfdm::this_file
