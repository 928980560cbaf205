#include "physics/point/ogden.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

// mu = 2, alpha = 2 is the neo-Hookean material: S = mu (l - 1/l^2); with -2 as well that of Mooney and Rivlin.
TEST(Ogden, HoldsTheNeoHookeanAndMooneyRivlinMaterials) {
  const OgdenTerm neo_hookean{2.0, 2.0};
  const OgdenTerm mooney_rivlin[] = {{2.0, 2.0}, {-0.5, -2.0}};
  for (const double l : {0.5, 0.9, 1.0, 1.3, 3.0}) {
    EXPECT_NEAR(nominal_stress({&neo_hookean, 1}, l), 2.0 * (l - 1.0 / (l * l)), 1e-13);
    const double both = (2.0 + 0.5 / l) * (l - 1.0 / (l * l));
    EXPECT_NEAR(nominal_stress(mooney_rivlin, l), both, 1e-13 * std::abs(both) + 1e-15);
  }
  EXPECT_DOUBLE_EQ(shear_modulus(mooney_rivlin), 2.5);
}

TEST(Ogden, HasThriceTheShearModulusForYoungs) {
  const OgdenTerm terms[] = {{0.63, 1.3}, {0.0012, 5.0}, {-0.01, -2.0}};  // Ogden's for rubber [MPa]
  const double h = 1e-5;
  const double slope = (nominal_stress(terms, 1.0 + h) - nominal_stress(terms, 1.0 - h)) / (2.0 * h);
  EXPECT_NEAR(slope, 3.0 * shear_modulus(terms), 1e-8);
}

}  // namespace
}  // namespace pfdm::this_file
