// Moduli and bounds of composites against the forms in which they were first given, for two phases.

#include "physics/elasticity/effective_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

const IsotropicElasticity matrix = from_young_poisson(75e6, 0.44), glass = from_young_poisson(70e9, 0.3);

// Hashin and Shtrikman, J. Mech. Phys. Solids 11 (1963) 127, eqs. 4.1 to 4.4: of phase 1, about which phase 2 is.
double bulk_bound(const IsotropicElasticity& c1, const IsotropicElasticity& c2, double f2) {
  const double K1 = c1.bulk_modulus(), K2 = c2.bulk_modulus(), G1 = c1.mu;
  return K1 + f2 / (1.0 / (K2 - K1) + 3.0 * (1.0 - f2) / (3.0 * K1 + 4.0 * G1));
}
double shear_bound(const IsotropicElasticity& c1, const IsotropicElasticity& c2, double f2) {
  const double K1 = c1.bulk_modulus(), G1 = c1.mu, G2 = c2.mu;
  return G1 + f2 / (1.0 / (G2 - G1) + 6.0 * (K1 + 2.0 * G1) * (1.0 - f2) / (5.0 * G1 * (3.0 * K1 + 4.0 * G1)));
}

TEST(EffectiveStiffness, BoundsOfTwoPhasesAreTheOriginalOnes) {
  for (const double f : {0.05, 0.3, 0.6}) {
    const Phase phases[] = {{1.0 - f, matrix}, {f, glass}};
    const ModulusBounds bounds = hashin_shtrikman(phases);
    EXPECT_NEAR(bounds.bulk_lower / bulk_bound(matrix, glass, f), 1.0, 1e-12);
    EXPECT_NEAR(bounds.bulk_upper / bulk_bound(glass, matrix, 1.0 - f), 1.0, 1e-12);
    EXPECT_NEAR(bounds.shear_lower / shear_bound(matrix, glass, f), 1.0, 1e-12);
    EXPECT_NEAR(bounds.shear_upper / shear_bound(glass, matrix, 1.0 - f), 1.0, 1e-12);
    const ModulusBounds wide = reuss_voigt(phases);
    EXPECT_NEAR(wide.bulk_lower, 1.0 / ((1.0 - f) / matrix.bulk_modulus() + f / glass.bulk_modulus()), 1.0);
    EXPECT_NEAR(wide.shear_upper, (1.0 - f) * matrix.mu + f * glass.mu, 1.0);
    EXPECT_LT(wide.bulk_lower, bounds.bulk_lower);
    EXPECT_LT(bounds.shear_upper, wide.shear_upper);
  }
}

TEST(EffectiveStiffness, IsotropicStiffnessIsItsOwnClosest) {
  const MandelMatrix C = stiffness_matrix(glass);
  EXPECT_NEAR(closest_isotropic(C).young_modulus(), 70e9, 1e-3);
  EXPECT_NEAR(closest_isotropic(C).poisson_ratio(), 0.3, 1e-12);
  EXPECT_LE(anisotropy(C), 1e-15);
  EXPECT_NEAR(universal_anisotropy(C), 0.0, 1e-12);
}

// C11, C12, C44 = 168.4, 121.4, 75.4 GPa of copper: A = 2 C44 / (C11 - C12) = 3.2085, and A^U = 6/5 (sqrt A - 1/sqrt
// A)^2 (Ranganathan and Ostoja-Starzewski, eq. 9); C44 stands in Voigt's matrix.
TEST(EffectiveStiffness, CubicCrystalHasItsUniversalAnisotropy) {
  MandelMatrix C = MandelMatrix::Zero();
  C.topLeftCorner<3, 3>().setConstant(121.4e9);
  C.diagonal() << 168.4e9, 168.4e9, 168.4e9, 150.8e9, 150.8e9, 150.8e9;
  const double A = 2.0 * 75.4 / (168.4 - 121.4), root = std::sqrt(A);
  EXPECT_NEAR(universal_anisotropy(C), 1.2 * (root - 1.0 / root) * (root - 1.0 / root), 1e-12);
  EXPECT_NEAR(voigt_stiffness(C)(3, 3), 75.4e9, 1.0);
  EXPECT_NEAR(voigt_compliance(C)(5, 5), 1.0 / 75.4e9, 1e-22);
  EXPECT_NEAR(closest_isotropic(C).bulk_modulus(), (168.4e9 + 2.0 * 121.4e9) / 3.0, 1.0);
  EXPECT_NEAR(closest_isotropic(C).mu, (168.4e9 - 121.4e9 + 3.0 * 75.4e9) / 5.0, 1.0);
  EXPECT_GT(anisotropy(C), 0.05);
}

TEST(EffectiveStiffness, AsymmetryIsThatOfTheSkewPart) {
  MandelMatrix C = MandelMatrix::Identity();
  C(0, 1) = 0.3;
  EXPECT_NEAR(asymmetry(C), 0.3 * std::sqrt(2.0) / std::sqrt(6.09), 1e-14);
}

}  // namespace
}  // namespace pfdm::this_file
