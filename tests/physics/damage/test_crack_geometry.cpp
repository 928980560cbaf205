#include "physics/damage/crack_geometry.h"

#include <cmath>
#include <numbers>

#include "physics/error.h"
#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

// int_0^b f(d) dd by the midpoint rule in t, d = b sin^2 t, which takes roots at either end out of the integrand.
double integral(const std::function<double(double)>& f, double b) {
  constexpr int n = 20000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double t = 0.5 * std::numbers::pi * (i + 0.5) / n;
    sum += f(b * std::pow(std::sin(t), 2)) * b * std::sin(2.0 * t);
  }
  return sum * 0.5 * std::numbers::pi / n;
}

TEST(CrackGeometry, GoesFromZeroToOneRising) {
  for (const CrackGeometry& law : crack_geometries()) {
    SCOPED_TRACE(law.name);
    EXPECT_EQ(law.alpha(0.0), 0.0);
    EXPECT_NEAR(law.alpha(1.0), 1.0, 1e-15);
    for (double d = 0.0; d < 1.0; d += 0.01) EXPECT_LT(law.alpha(d), law.alpha(d + 0.01)) << d;
  }
}

TEST(CrackGeometry, DerivativesAreThoseOfTheFunction) {
  for (const CrackGeometry& law : crack_geometries()) {
    SCOPED_TRACE(law.name);
    for (const double d : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      EXPECT_NEAR(law.alpha_prime(d), slope(law.alpha, d), 1e-8) << d;
      EXPECT_NEAR(law.alpha_second(d), slope(law.alpha_prime, d), 1e-8) << d;
    }
  }
}

// With this c0 a broken bar dissipates Gc: both halves of (Gc/c0) int (alpha/ell + ell d'^2) dx at alpha = ell^2 d'^2.
TEST(CrackGeometry, ConstantIsFourTimesTheIntegralOfTheRoot) {
  for (const CrackGeometry& law : crack_geometries())
    EXPECT_NEAR(law.c0, 4.0 * integral([&](double d) { return std::sqrt(law.alpha(d)); }, 1.0), 1e-7) << law.name;
}

// The broken profile falls by ell d' = -sqrt(alpha); its half-width is int_0^1 dd / sqrt(alpha).
TEST(CrackGeometry, SupportIsThatOfTheBrokenProfile) {
  for (const CrackGeometry& law : crack_geometries()) {
    const double width = integral([&](double d) { return 1.0 / std::sqrt(law.alpha(d)); }, 1.0);
    if (std::isfinite(law.support))
      EXPECT_NEAR(law.support, width, 1e-6) << law.name;
    else
      EXPECT_GT(width, 15.0) << law.name << ": grows with the logarithm of the resolution";
  }
}

TEST(CrackGeometry, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(crack_geometries(), crack_geometry);
}

}  // namespace
}  // namespace pfdm::this_file
