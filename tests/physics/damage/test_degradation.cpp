#include "physics/damage/degradation.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "physics/error.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

constexpr double E = 30e9, Gf = 120.0, ft = 3e6, ell = 10e-3;

// Every degradation with every set of coefficients that it may be given.
void for_laws(const std::function<void(const Degradation&)>& check) {
  for (const DegradationLaw& law : degradations()) {
    SCOPED_TRACE(law.name);
    if (!law.needs_strength) check(Degradation(law));
    if (law.parameters.size() == 1) check(Degradation(law, {0.3}));
    for (const SofteningLaw& softening : softening_laws()) {
      SCOPED_TRACE(softening.name);
      if (law.needs_strength) check(rational_degradation(rational_coefficients(softening, E, Gf, ft, ell)));
    }
  }
}

TEST(Degradation, GoesFromOneToZeroWithoutRising) {
  for_laws([](const Degradation& law) {
    EXPECT_EQ(law.g(0.0), 1.0);
    EXPECT_NEAR(law.g(1.0), 0.0, 1e-15);
    for (double d = 0.0; d < 0.995; d += 0.01) EXPECT_GE(law.g(d), law.g(d + 0.01)) << d;
  });
}

// Otherwise the driving force would not vanish in a broken cell, and damage would overshoot 1.
TEST(Degradation, HasNoSlopeWhereBroken) {
  for_laws([](const Degradation& law) { EXPECT_NEAR(law.g_prime(1.0), 0.0, 1e-15); });
}

TEST(Degradation, DerivativesAreThoseOfTheFunction) {
  for_laws([](const Degradation& law) {
    for (const double d : {1e-3, 0.13, 0.5, 0.77, 0.99}) {
      const auto g = [&](double x) { return law.g(x); };
      const auto g_prime = [&](double x) { return law.g_prime(x); };
      EXPECT_NEAR(law.g_prime(d), slope(g, d, 1e-6), 1e-6 * (1.0 + std::abs(law.g_prime(d)))) << d;
      EXPECT_NEAR(law.g_second(d), slope(g_prime, d, 1e-6), 1e-6 * (1.0 + std::abs(law.g_second(d)))) << d;
    }
  });
}

// Borden 2016, eq. 30: the slope at d = 0 is -s.
TEST(Degradation, CubicBeginsWithItsSlope) {
  for (const double s : {1e-4, 0.3, 2.0}) EXPECT_EQ(Degradation(degradation_law("cubic"), {s}).g_prime(0.0), -s);
}

// Homogeneous tension: damage begins where -g'(0) psi = alpha'(0) Gf/(c0 ell), and that is at ft for any law and ell.
TEST(Degradation, RationalDamageBeginsAtTheStrength) {
  for (const SofteningLaw& softening : softening_laws())
    for (const double length : {2e-3, 10e-3, 40e-3}) {
      const Degradation law = rational_degradation(rational_coefficients(softening, E, Gf, ft, length));
      const double psi = 2.0 * Gf / (std::numbers::pi * length) / -law.g_prime(0.0);
      EXPECT_NEAR(std::sqrt(2.0 * E * psi), ft, 1e-9 * ft) << softening.name;
    }
}

TEST(Degradation, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(degradations(), degradation_law);
}

}  // namespace
}  // namespace pfdm::this_file
