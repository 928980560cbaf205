#include "physics/interface_law.h"

#include "physics/error.h"
#include "physics/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr InterfaceStrength glued{
    .strength = 3e6, .toughness = 120.0, .shear_strength = 5e6, .shear_toughness = 300.0, .stiffness = 2e12};
const Vector n = Vector(1.0, 2.0, -2.0) / 3.0, s = Vector(2.0, 1.0, 2.0) / 3.0;

std::vector<double> inner_shape(const TractionSeparationLaw& law) {
  std::vector<double> shape;
  for (std::size_t i = law.has_rise() ? 1 : 0; i < law.shape.size(); ++i) shape.push_back(law.shape[i].first);
  return shape;
}

InterfaceLaw interface_with(const TractionSeparationLaw& law, std::string_view mode, double ratio = 1.0,
                            double exponent = 1.0) {
  return {.law = &law,
          .shape = inner_shape(law),
          .mixed_mode = &find_by_name(mixed_modes(), mode, "mixed mode"),
          .shear_ratio = ratio,
          .exponent = exponent};
}

const TractionSeparationLaw& law_named(std::string_view name) {
  return find_by_name(traction_separation_laws(), name, "law");
}

double one_mode_traction(const TractionSeparationLaw& law, double separation, const InterfaceStrength& at) {
  std::vector<double> shape = inner_shape(law);
  if (law.has_rise()) shape.insert(shape.begin(), at.strength * at.strength / (2.0 * at.stiffness * at.toughness));
  return law.traction(law, separation, at.strength, at.toughness, shape);
}

// Central differences of the traction.
Tensor differences(const InterfaceLaw& law, const Vector& at, const InterfaceHistory& before, double step) {
  Tensor tangent;
  for (int i = 0; i < 3; ++i) {
    const Vector d = step * Vector::Unit(i);
    tangent.col(i) = (law.respond(glued, n, at + d, before).traction - law.respond(glued, n, at - d, before).traction) /
                     (2.0 * step);
  }
  return tangent;
}

class InterfaceOfLaw : public testing::TestWithParam<TractionSeparationLaw> {
 protected:
  double length() const { return glued.toughness / glued.strength; }
};

TEST_P(InterfaceOfLaw, SlopeAndWorkAreThoseOfTheTraction) {
  std::vector<double> shape;
  for (const ShapeParameter& p : GetParam().shape) shape.push_back(p.first);
  const auto at = [&](double x) { return GetParam().at(GetParam(), x * length(), 3e6, 120.0, shape); };
  for (const double x : {0.001, 0.03, 0.2, 0.7, 1.9, 4.0}) {
    constexpr double step = 1e-6;
    const double slope = (at(x + step).traction - at(x - step).traction) / (2.0 * step * length());
    EXPECT_NEAR(at(x).slope, slope, 1e-6 * (3e6 / length())) << x;
    const double work = (at(x + step).work - at(x - step).work) / (2.0 * step * length());
    EXPECT_NEAR(at(x).traction, work, 1e-7 * 3e6) << x;
  }
  EXPECT_EQ(at(0.0).work, 0.0);
  EXPECT_NEAR(at(1e4).work, 120.0, GetParam().name == "hyperbolic" ? 0.02 : 2e-4 * 120.0);
}

TEST_P(InterfaceOfLaw, OpensByTheLawAndShearsByItTimesBeta) {
  const InterfaceLaw law = interface_with(GetParam(), "camacho_ortiz", 0.7);
  for (const double x : {0.004, 0.1, 0.6, 1.5, 3.0}) {
    const double opening = x * length();
    const Vector pulled = law.respond(glued, n, opening * n, {}).traction;
    EXPECT_LT((pulled - one_mode_traction(GetParam(), opening, glued) * n).norm(), 1e-10 * 3e6);
    const Vector sheared = law.respond(glued, n, opening / 0.7 * s, {}).traction;
    EXPECT_LT((sheared - 0.7 * one_mode_traction(GetParam(), opening, glued) * s).norm(), 1e-10 * 3e6);
  }
}

TEST_P(InterfaceOfLaw, UnloadsToTheOriginAndClosesStiffly) {
  const InterfaceLaw law = interface_with(GetParam(), "camacho_ortiz", 0.7);
  const Vector far = length() * (0.8 * n + 0.5 * s);
  const InterfaceResponse opened = law.respond(glued, n, far, {});
  for (const double part : {0.9, 0.3, 0.0}) {
    const InterfaceResponse back = law.respond(glued, n, part * far, opened.history);
    EXPECT_LT((back.traction - part * opened.traction).norm(), 1e-10 * 3e6);
    EXPECT_EQ(back.history.dissipated, opened.history.dissipated);
  }
  const double K = law.initial_stiffness(glued);
  const Vector pressed = law.respond(glued, n, -0.01 * length() * n, opened.history).traction;
  EXPECT_LT((pressed + 0.01 * length() * K * n).norm(), 1e-10 * 0.01 * length() * K);
}

// The work on a path in mixed mode that does not come back is what is stored and dissipated.
TEST_P(InterfaceOfLaw, StoresOrDissipatesTheWork) {
  for (const MixedMode& mode : mixed_modes()) {
    if (mode.at != nullptr && !GetParam().has_rise()) continue;
    const InterfaceLaw law = interface_with(GetParam(), mode.name, mode.at == nullptr ? 0.8 : 1.0, 2.3);
    const Vector end = 1.3 * length() * (0.8 * n + 0.6 * s);
    double work = 0.0;
    constexpr int steps = 40000;
    InterfaceHistory history;
    InterfaceResponse last = law.respond(glued, n, Vector::Zero(), history);
    for (int i = 1; i <= steps; ++i) {
      const InterfaceResponse now = law.respond(glued, n, double(i) / steps * end, history);
      work += 0.5 * (now.traction + last.traction).dot(end) / steps;
      history = now.history;
      last = now;
    }
    EXPECT_NEAR(last.stored + last.history.dissipated, work, 1e-4 * work) << mode.name;
    const InterfaceResponse at_once = law.respond(glued, n, end, {});
    EXPECT_NEAR(at_once.history.dissipated, last.history.dissipated, 1e-10 * work) << mode.name;
  }
}

TEST_P(InterfaceOfLaw, TangentIsTheDerivative) {
  for (const MixedMode& mode : mixed_modes()) {
    if (mode.at != nullptr && !GetParam().has_rise()) continue;
    InterfaceLaw law = interface_with(GetParam(), mode.name, mode.at == nullptr ? 0.8 : 1.0, 2.3);
    law.friction = 0.4;
    const InterfaceHistory broken = law.respond(glued, n, 0.4 * length() * (0.8 * n + 0.6 * s), {}).history;
    for (const InterfaceHistory& before : {InterfaceHistory{}, broken})
      for (const double size : {0.002, 0.3, 0.9})
        for (const Vector& direction : {Vector(0.8 * n + 0.6 * s), Vector(-0.05 * n + s), Vector(-0.6 * n + 0.8 * s)}) {
          const Vector at = size * length() * direction;
          const InterfaceResponse response = law.respond(glued, n, at, before);
          const Tensor tangent = differences(law, at, before, 1e-6 * at.norm());
          EXPECT_LT((response.tangent - tangent).norm(), 1e-6 * law.initial_stiffness(glued))
              << mode.name << " " << size << " " << direction.transpose();
          const auto dissipated = [&](double factor) {
            return law.respond(glued, n, factor * at, before).history.dissipated;
          };
          EXPECT_NEAR(response.dissipation_slope.dot(at), (dissipated(1.0 + 1e-6) - dissipated(1.0 - 1e-6)) / 2e-6,
                      1e-6 * glued.toughness)
              << mode.name << " " << size << " " << direction.transpose();
          EXPECT_LT((response.secant - response.secant.transpose()).norm(), 1e-12 * law.initial_stiffness(glued));
        }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, InterfaceOfLaw, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

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
}  // namespace pfdm
