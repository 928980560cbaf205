// The apparent toughness against its closed forms (literature.md 4.1) and against a minimum found on a grid.

#include "physics/interfaces/interface_toughness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

constexpr double ell = 20e-6, undamageable = std::numeric_limits<double>::infinity();

TEST(InterfaceToughness, IsTheClosedFormOfAt2) {
  for (const double b : {0.25, 0.5, 1.0, 2.0, 3.0})
    for (const double ratio : {0.5, 2.0, 10.0, 100.0}) {
      const double t = std::tanh(b);
      const double expected = (ratio + t) / (1.0 + ratio * t);
      EXPECT_NEAR(
          apparent_toughness(crack_geometry("AT2"), 281.0, 2.0 * b * ell, ell, {281.0 * ratio}, {281.0 * ratio}),
          281.0 * expected, 281.0 * expected * 2e-5)
          << b << ", " << ratio;
    }
}

// The table of literature.md 4.1, last column, and one undamageable side beside a tougher one.
TEST(InterfaceToughness, UndamageableSideIsTheHyperbolicCotangent) {
  for (const double b : {0.25, 0.5, 1.0, 2.0, 3.0}) {
    const CrackGeometry& at2 = crack_geometry("AT2");
    EXPECT_NEAR(apparent_toughness(at2, 1.0, 2.0 * b * ell, ell, {undamageable}, {undamageable}), 1.0 / std::tanh(b),
                5e-5 / std::tanh(b));
    const double t = std::tanh(b);
    EXPECT_NEAR(apparent_toughness(at2, 1.0, 2.0 * b * ell, ell, {undamageable}, {10.0}),
                0.5 * (1.0 / t + (10.0 + t) / (1.0 + 10.0 * t)), 5e-5 / t);
  }
}

TEST(InterfaceToughness, EqualNeighboursAndWideBandsChangeNothing) {
  for (const CrackGeometry& crack : crack_geometries()) {
    EXPECT_NEAR(apparent_toughness(crack, 7.0, 0.8 * ell, ell, {7.0}, {7.0}), 7.0, 7.0 * 2e-5) << crack.name;
    EXPECT_NEAR(apparent_toughness(crack, 7.0, 20.0 * ell, ell, {undamageable}, {70.0}), 7.0, 7.0 * 1e-4) << crack.name;
  }
}

// Least energy of a row of nodes across half a band and beyond, by projected Gauss-Seidel.
double least_energy(const CrackGeometry& crack, double half, double ratio) {
  const double h = half / 40.0;
  const int in_band = 40, n = 40 + static_cast<int>(3.0 / h);
  std::vector<double> d(n + 1, 0.0);
  d[0] = 1.0;
  for (int i = 1; i <= n; ++i) d[i] = std::max(0.0, 1.0 - i * h / 1.5);
  const auto G = [&](int link) { return link < in_band ? 1.0 : ratio; };  // between nodes link and link + 1
  for (int sweep = 0; sweep < 40000; ++sweep)
    for (int i = 1; i < n; ++i) {
      const double left = G(i - 1), right = G(i), mean = 0.5 * (left + right), x = d[i];
      const double slope = mean * h * crack.alpha_prime(x) + 2.0 / h * (left * (x - d[i - 1]) + right * (x - d[i + 1]));
      const double curvature = mean * h * std::max(crack.alpha_second(x), 0.0) + 2.0 / h * (left + right);
      d[i] = std::clamp(x - 1.6 * slope / curvature, 0.0, 1.0);
    }
  double energy = 0.0;
  for (int i = 0; i < n; ++i) {
    const double rise = d[i + 1] - d[i];
    energy += G(i) * (0.5 * h * (crack.alpha(d[i]) + crack.alpha(d[i + 1])) + rise * rise / h);
  }
  return energy / crack.c0;
}

TEST(InterfaceToughness, IsTheLeastEnergyOfEveryGeometry) {
  for (const CrackGeometry& crack : crack_geometries())
    for (const double half : {0.5, 1.0}) {
      const double expected = 2.0 * least_energy(crack, half, 5.0);
      EXPECT_NEAR(apparent_toughness(crack, 1.0, 2.0 * half * ell, ell, {5.0}, {5.0}), expected, 3e-3 * expected)
          << crack.name << ", half width " << half << " ell";
    }
}

// literature.md 4.1: G = 281, bulk 2810, b = 50 um, ell = 20 um.
TEST(InterfaceToughness, CorrectionIsThePublishedOne) {
  EXPECT_NEAR(band_toughness(crack_geometry("AT2"), 281.0, 100e-6, 20e-6, {2810.0}, {2810.0}), 277.912, 0.01);
  for (const CrackGeometry& crack : crack_geometries())
    for (const double width : {0.5, 1.0, 3.0}) {
      const double G = band_toughness(crack, 400.0, width * ell, ell, {undamageable}, {10000.0});
      EXPECT_NEAR(apparent_toughness(crack, G, width * ell, ell, {undamageable}, {10000.0}), 400.0, 1e-6) << crack.name;
    }
}

}  // namespace
}  // namespace pfdm::this_file
