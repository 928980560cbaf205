#include "physics/damage/fatigue.h"

#include <cmath>
#include <functional>

#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

constexpr double threshold = 2e3;  // [J/m^3]

void for_laws(const std::function<void(const Fatigue&)>& check) {
  for (const FatigueLaw& law : fatigue_laws()) {
    SCOPED_TRACE(law.name);
    check(Fatigue(law, threshold, {0.5}));
    check(Fatigue(law, threshold, {0.1}));
  }
}

TEST(Fatigue, LeavesTheToughnessUpToTheThreshold) {
  EXPECT_EQ(Fatigue().factor(1e30), 1.0);
  for_laws([](const Fatigue& law) {
    for (const double energy : {0.0, 0.3 * threshold, threshold}) EXPECT_EQ(law.factor(energy), 1.0);
    EXPECT_NEAR(law.factor(threshold * (1.0 + 1e-9)), 1.0, 2e-9);
  });
}

TEST(Fatigue, FallsBeyondIt) {
  for_laws([](const Fatigue& law) {
    for (double x = 1.0; x < 1e9; x *= 1.3) {
      EXPECT_GE(law.factor(x * threshold), law.factor(1.3 * x * threshold)) << x;
      EXPECT_GT(law.factor(1.3 * x * threshold), 0.0) << x;
    }
  });
}

// Carrara 2020: both laws at values that can be told by hand.
TEST(Fatigue, HasThePublishedValues) {
  const Fatigue asymptotic(fatigue_law("asymptotic"), threshold, {});
  EXPECT_NEAR(asymptotic.factor(3.0 * threshold), 0.25, 1e-15);
  EXPECT_NEAR(asymptotic.factor(9.0 * threshold), 0.04, 1e-15);
  const Fatigue logarithmic(fatigue_law("logarithmic"), threshold, {0.5});
  EXPECT_NEAR(logarithmic.factor(10.0 * threshold), 0.25, 1e-15);
  EXPECT_NEAR(logarithmic.factor(std::sqrt(10.0) * threshold), 0.5625, 1e-15);
  EXPECT_LE(logarithmic.factor(100.0 * threshold), 1e-6);
  EXPECT_LE(logarithmic.factor(1e9 * threshold), 1e-6);
}

TEST(Fatigue, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(fatigue_laws(), fatigue_law);
}

}  // namespace
}  // namespace pfdm::this_file
