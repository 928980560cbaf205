#include "physics/elasticity/elasticity.h"

#include <limits>

#include "physics/error.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

TEST(Elasticity, YoungAndPoissonComeBack) {
  for (const double E : {75e6, 70e9})
    for (const double nu : {-0.5, 0.0, 0.3, 0.44, 0.4999}) {
      const IsotropicElasticity c = from_young_poisson(E, nu);
      EXPECT_NEAR(c.young_modulus(), E, 1e-9 * E) << nu;
      EXPECT_NEAR(c.poisson_ratio(), nu, 1e-9) << nu;
      EXPECT_NEAR(c.bulk_modulus(), E / (3.0 * (1.0 - 2.0 * nu)), 1e-9 * c.bulk_modulus()) << nu;
      EXPECT_NEAR(c.constrained_modulus(), E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)),
                  1e-9 * c.constrained_modulus())
          << nu;
    }
}

TEST(Elasticity, UniaxialStressStretchesByEAndContractsByNu) {
  const IsotropicElasticity c = from_young_poisson(70e9, 0.3);
  const Tensor eps = Vector(1e-3, -0.3e-3, -0.3e-3).asDiagonal();
  EXPECT_LE((stress(c, eps) - Tensor(Vector(70e6, 0.0, 0.0).asDiagonal())).norm(), 1e-6);
}

TEST(Elasticity, StressIsTheSlopeOfTheEnergy) {
  const IsotropicElasticity c = from_young_poisson(75e6, 0.44);
  RandomTensors random;
  for (int i = 0; i < 10; ++i) {
    const Tensor eps = random.symmetric(1e-2);
    const Tensor expected = slope([&](const Tensor& e) { return energy_density(c, e); }, eps, 1e-5);
    EXPECT_LE((stress(c, eps) - expected).norm(), 1e-7 * expected.norm());
  }
}

TEST(Elasticity, RefusesWhatNoMaterialHas) {
  EXPECT_THAT(message_of<InputError>([] { from_young_poisson(0.0, 0.3); }), HasSubstr("must be positive"));
  EXPECT_THAT(message_of<InputError>([] { from_young_poisson(-7e10, 0.3); }), HasSubstr("-7"));
  EXPECT_THAT(message_of<InputError>([] { from_young_poisson(7e10, 0.5); }), HasSubstr("between -1 and 0.5"));
  EXPECT_THAT(message_of<InputError>([] { from_young_poisson(7e10, -1.0); }), HasSubstr("between -1 and 0.5"));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(from_young_poisson(nan, 0.3), InputError);
  EXPECT_THROW(from_young_poisson(7e10, nan), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
