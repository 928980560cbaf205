#include "physics/degradation.h"
#include "physics/error.h"
#include "tests/physics/physics_checks.h"

namespace pfdm {
namespace {

TEST(Degradation, GoesFromOneToZeroWithoutRising) {
  for (const Degradation& law : degradations()) {
    SCOPED_TRACE(law.name);
    EXPECT_EQ(law.g(0.0), 1.0);
    EXPECT_NEAR(law.g(1.0), 0.0, 1e-15);
    for (double d = 0.0; d < 1.0; d += 0.01) EXPECT_GE(law.g(d), law.g(d + 0.01)) << d;
  }
}

// Otherwise the driving force would not vanish in a broken cell, and damage would overshoot 1.
TEST(Degradation, HasNoSlopeWhereBroken) {
  for (const Degradation& law : degradations()) EXPECT_NEAR(law.g_prime(1.0), 0.0, 1e-15) << law.name;
}

TEST(Degradation, DerivativesAreThoseOfTheFunction) {
  for (const Degradation& law : degradations()) {
    SCOPED_TRACE(law.name);
    for (const double d : {0.0, 0.13, 0.5, 0.77, 0.99}) {
      EXPECT_NEAR(law.g_prime(d), slope(law.g, d), 1e-8) << d;
      EXPECT_NEAR(law.g_second(d), slope(law.g_prime, d), 1e-8) << d;
    }
  }
}

TEST(Degradation, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(degradations(), degradation);
}

}  // namespace
}  // namespace pfdm
