// Rules of mixed mode, friction and tabulated laws of interfaces, by what is known of them.

#include "physics/error.h"
#include "physics/interfaces/interface_law.h"
#include "physics/registry.h"
#include "tests/physics/glued_interfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm::this_file {
namespace {

using namespace glued_interfaces;

// Of the triangle at a mode mixity B: onset at sigma(B)/K, end at 2 Gc(B)/sigma(B), dissipated Gc(B).
class LinearInMixedMode : public testing::TestWithParam<std::string_view> {
 protected:
  static constexpr double B = 0.36, exponent = 1.7;
  double toughness() const {
    if (GetParam() == "benzeggagh_kenane") return 120.0 + 180.0 * std::pow(B, exponent);
    return 1.0 / std::pow(std::pow((1.0 - B) / 120.0, exponent) + std::pow(B / 300.0, exponent), 1.0 / exponent);
  }
  double strength() const {
    if (GetParam() == "benzeggagh_kenane") return 1e6 * std::sqrt(9.0 + 16.0 * std::pow(B, exponent));
    return 1e6 / std::sqrt((1.0 - B) / 9.0 + B / 25.0);
  }
};

TEST_P(LinearInMixedMode, IsTheTriangleOfItsMode) {
  const InterfaceLaw law = interface_with(law_named("linear"), GetParam(), 1.0, exponent);
  const Vector direction = 0.8 * n + 0.6 * s;
  const double onset = strength() / glued.stiffness, end = 2.0 * toughness() / strength();
  const auto traction = [&](double lambda) { return law.respond(glued, n, lambda * direction, {}).traction; };
  EXPECT_LT((traction(0.5 * onset) - 0.5 * strength() * direction).norm(), 1e-10 * strength());
  for (const double part : {0.0, 0.25, 0.8}) {
    const Vector expected = (1.0 - part) * strength() * direction;
    EXPECT_LT((traction(onset + part * (end - onset)) - expected).norm(), 1e-9 * strength()) << part;
  }
  EXPECT_EQ(traction(1.01 * end).norm(), 0.0);
  EXPECT_NEAR(law.respond(glued, n, 2.0 * end * direction, {}).history.dissipated, toughness(), 1e-10 * toughness());
}

// Its damage is the part of the toughness of its mode, whichever of the modes is the tougher.
TEST_P(LinearInMixedMode, IsWhollyDamagedOnceBrokenInAnyMode) {
  const InterfaceLaw law = interface_with(law_named("linear"), GetParam(), 1.0, exponent);
  const auto damage = [&](const InterfaceStrength& at, const Vector& separation) {
    return law.damage(at, n, separation, law.respond(at, n, separation, {}).history);
  };
  EXPECT_EQ(damage(glued, Vector::Zero()), 0.0);
  EXPECT_EQ(damage(glued, 1e-7 * n), 0.0);
  EXPECT_NEAR(damage(glued, 1e-3 * n), 1.0, 1e-12);
  EXPECT_NEAR(damage(glued, 1e-3 * s), 1.0, 1e-12);
  EXPECT_NEAR(damage(glued, 1e-3 * (0.8 * n + 0.6 * s)), 1.0, 1e-12);
  // In opening the triangle rises to 1.5 um and ends at 80 um; half the traction times the end is left.
  const double opening = 40e-6, traction = 3e6 * (80e-6 - opening) / (80e-6 - 1.5e-6);
  const double dissipated = 120.0 - 0.5 * traction * 80e-6;
  EXPECT_NEAR(damage(glued, opening * n), dissipated / 120.0, 1e-9);
  // What is left belongs to the mode of now: broken in opening by D, then loaded in shear to below the secant.
  const InterfaceHistory history = law.respond(glued, n, opening * n, {}).history;
  const double secant = traction / opening, end = 2.0 * 300.0 / 5e6, rise = 5e6 / 2e12;
  const double at = 5e6 * end / (secant * (end - rise) + 5e6);  // where the triangle in shear meets it
  EXPECT_NEAR(law.damage(glued, n, 1e-7 * s, history), dissipated / (dissipated + 0.5 * secant * at * end), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Rules, LinearInMixedMode, testing::Values("benzeggagh_kenane", "power_law"),
                         [](const auto& test) { return std::string(test.param); });

// T = S (<delta_n> n + delta_s), lambda^2 = <delta_n>^2 + b^2 |delta_s|^2, S = e^2 strength^2/Gc exp(-lambda/delta_0):
// Smith and Ferrante's law with a coupling coefficient b = 1/shear_ratio.
TEST(EqualStiffness, IsSmithAndFerrantesLaw) {
  constexpr double b = 2.0, delta_0 = 120.0 / (std::numbers::e * 3e6);
  const InterfaceLaw law = interface_with(law_named("xu_needleman"), "equal_stiffness", 1.0 / b);
  for (const double x : {0.0, 0.3, 1.0, 4.0})
    for (const double y : {0.0, 0.2, 0.9, 3.0}) {
      const double lambda = delta_0 * std::hypot(x, b * y),
                   S = 3e6 * std::numbers::e / delta_0 * std::exp(-lambda / delta_0);
      const Vector at = delta_0 * (x * n + y * s);
      EXPECT_LT((law.respond(glued, n, at, {}).traction - S * at).norm(), 1e-10 * 3e6) << x << " " << y;
    }
  EXPECT_TRUE(law.pulls_along_separation());
  // Its strength in shear is that in opening over b, its toughness over b^2.
  EXPECT_NEAR(law.respond(glued, n, delta_0 / b * s, {}).traction.dot(s), 3e6 / b, 1e-8 * 3e6);
  EXPECT_NEAR(law.respond(glued, n, 60.0 * delta_0 * s, {}).history.dissipated, 120.0 / (b * b), 1e-10 * 120.0);
  EXPECT_NEAR(law.damage(glued, n, 60.0 * delta_0 * s, law.respond(glued, n, 60.0 * delta_0 * s, {}).history), 1.0,
              1e-10);
}

// With a straight rise it is the power law of exponent 1 with the same strengths and toughnesses.
TEST(EqualStiffness, IsThePowerLawOfItsStrengths) {
  constexpr double ratio = 0.6;
  InterfaceStrength at = glued;
  at.shear_strength = ratio * at.strength, at.shear_toughness = ratio * ratio * at.toughness;
  const InterfaceLaw one = interface_with(law_named("bilinear"), "equal_stiffness", ratio);
  const InterfaceLaw other = interface_with(law_named("bilinear"), "power_law");
  InterfaceHistory of_one, of_other;
  for (const Vector& part : {Vector(0.01 * n), Vector(0.2 * n + 0.3 * s), Vector(0.1 * n), Vector(0.3 * n + 0.9 * s)}) {
    const Vector delta = at.toughness / at.strength * part;
    const InterfaceResponse a = one.respond(at, n, delta, of_one), b = other.respond(at, n, delta, of_other);
    EXPECT_LT((a.traction - b.traction).norm(), 1e-9 * at.strength) << part.transpose();
    of_one = a.history, of_other = b.history;
  }
}

// The published tractions (Xu, Needleman 1994) with r = 0, here by differences of their potential.
TEST(XuNeedlemanPotential, HasThePublishedTractions) {
  for (const double q : {1.0, 0.4}) {
    InterfaceStrength at = glued;
    at.shear_toughness = q * at.toughness;
    const double length_n = at.toughness / (std::numbers::e * at.strength);
    const double length_s = at.shear_toughness / (std::sqrt(0.5 * std::numbers::e) * at.shear_strength);
    constexpr double r = 0.0;
    const auto phi = [&](double delta_n, double delta_s) {
      const double x = delta_n / length_n, y = delta_s / length_s, decay = std::exp(-y * y);
      return at.toughness *
             (1.0 + std::exp(-x) * ((1.0 - r + x) * (1.0 - q) / (r - 1.0) - (q + (r - q) / (r - 1.0) * x) * decay));
    };
    const InterfaceLaw law = interface_with(law_named("xu_needleman"), "xu_needleman");
    for (const double x : {0.1, 0.7, 1.0, 3.0})
      for (const double y : {0.1, 0.5, 1.0, 2.0}) {
        const double delta_n = x * length_n, delta_s = y * length_s, h = 1e-5;
        const double T_n =
            (phi(delta_n + h * length_n, delta_s) - phi(delta_n - h * length_n, delta_s)) / (2 * h * length_n);
        const double T_s =
            (phi(delta_n, delta_s + h * length_s) - phi(delta_n, delta_s - h * length_s)) / (2 * h * length_s);
        const InterfaceResponse now = law.respond(at, n, delta_n * n + delta_s * s, {});
        EXPECT_LT((now.traction - T_n * n - T_s * s).norm(), 1e-8 * at.shear_strength) << q << " " << x << " " << y;
        EXPECT_NEAR(now.stored + now.history.dissipated, phi(delta_n, delta_s), 1e-9 * at.toughness);
      }
    EXPECT_NEAR(law.respond(at, n, length_n * n, {}).traction.dot(n), at.strength, 1e-8 * at.strength);
    EXPECT_NEAR(law.respond(at, n, std::sqrt(0.5) * length_s * s, {}).traction.dot(s), at.shear_strength,
                1e-8 * at.shear_strength);
    EXPECT_NEAR(law.respond(at, n, 8.0 * length_s * s, {}).history.dissipated, q * at.toughness, 1e-9 * at.toughness);
    EXPECT_NEAR(law.damage(at, n, 8.0 * length_s * s, law.respond(at, n, 8.0 * length_s * s, {}).history), 1.0, 1e-9);
    EXPECT_FALSE(law.pulls_along_separation());
  }
}

TEST(InterfaceFriction, SlidesAtCoulombsLimitOnceBroken) {
  InterfaceLaw law = interface_with(law_named("linear"), "camacho_ortiz");
  law.friction = 0.3;
  const InterfaceHistory broken = law.respond(glued, n, 1e-3 * n, {}).history;
  const Vector pressed = -1e-6 * n;
  const double pressure = 1e-6 * glued.stiffness;
  const InterfaceResponse sticks =
      law.respond(glued, n, pressed + 1e-7 * s, law.respond(glued, n, pressed, broken).history);
  EXPECT_NEAR(sticks.traction.dot(s), 1e-7 * glued.stiffness, 1e-10 * pressure);
  const InterfaceResponse slides = law.respond(glued, n, pressed + 2e-5 * s, sticks.history);
  EXPECT_NEAR(slides.traction.dot(s), 0.3 * pressure, 1e-10 * pressure);
  const InterfaceResponse on = law.respond(glued, n, pressed + 5e-5 * s, slides.history);
  EXPECT_NEAR(on.history.rubbed - slides.history.rubbed, 0.3 * pressure * 3e-5, 1e-9 * pressure * 3e-5);
  const InterfaceResponse back = law.respond(glued, n, pressed + 1e-5 * s, on.history);
  EXPECT_NEAR(back.traction.dot(s), -0.3 * pressure, 1e-10 * pressure);
}

TEST(TabulatedLaw, IsItsPoints) {
  const double x[] = {1e-6, 4e-6, 1e-5}, y[] = {2e6, 3e6, 0.0};
  const TabulatedPoints points = tabulate(x, y);
  EXPECT_EQ(points.strength, 3e6);
  EXPECT_NEAR(points.energy, 0.5 * 1e-6 * 2e6 + 2.5e6 * 3e-6 + 0.5 * 3e6 * 6e-6, 1e-12);
  const InterfaceLaw law{.law = &tabulated_law(), .shape = points.shape, .mixed_mode = mixed_modes().data()};
  const InterfaceStrength at{.strength = points.strength, .toughness = points.energy};
  const auto traction = [&](double opening) { return law.respond(at, n, opening * n, {}).traction.dot(n); };
  EXPECT_NEAR(traction(0.5e-6), 1e6, 1e-4);
  EXPECT_NEAR(traction(2.5e-6), 2.5e6, 1e-4);
  EXPECT_NEAR(traction(7e-6), 1.5e6, 1e-4);
  EXPECT_EQ(traction(2e-5), 0.0);
  EXPECT_NEAR(law.respond(at, n, 2e-5 * n, {}).history.dissipated, points.energy, 1e-12 * points.energy);
  EXPECT_THROW(tabulate(std::vector{0.0, 1e-6}, std::vector{1e6, 0.0}), InputError);
  EXPECT_THROW(tabulate(std::vector{1e-6, 1e-6}, std::vector{1e6, 0.0}), InputError);
}

}  // namespace
}  // namespace pfdm::this_file
