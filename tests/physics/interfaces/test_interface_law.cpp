#include "physics/interfaces/interface_law.h"

#include "physics/error.h"
#include "physics/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
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
  const MixedMode& rule = find_by_name(mixed_modes(), mode, "mixed mode");
  return {.law = &law,
          .shape = inner_shape(law),
          .mixed_mode = &rule,
          .shear_ratio = rule.has_shear_strength() ? 1.0 : ratio,
          .exponent = exponent};
}

/// The rules that mix the modes of a law.
std::vector<std::string_view> rules_of(const TractionSeparationLaw& law) {
  std::vector<std::string_view> names;
  for (const MixedMode& mode : mixed_modes())
    if (mode.suits(law)) names.push_back(mode.name);
  return names;
}

/// The potential wants less toughness in shear than in opening.
InterfaceStrength glue_for(std::string_view mode) {
  InterfaceStrength at = glued;
  if (mode == "xu_needleman") at.shear_toughness = 0.7 * at.toughness;
  return at;
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
Tensor differences(const InterfaceLaw& law, const InterfaceStrength& glue, const Vector& at,
                   const InterfaceHistory& before, double step) {
  Tensor tangent;
  for (int i = 0; i < 3; ++i) {
    const Vector d = step * Vector::Unit(i);
    tangent.col(i) =
        (law.respond(glue, n, at + d, before).traction - law.respond(glue, n, at - d, before).traction) / (2.0 * step);
  }
  return tangent;
}

// Likewise of what is dissipated by decohesion.
Vector dissipation_differences(const InterfaceLaw& law, const InterfaceStrength& glue, const Vector& at,
                               const InterfaceHistory& before, double step) {
  Vector slope;
  for (int i = 0; i < 3; ++i) {
    const auto dissipated = [&](double sign) {
      return law.respond(glue, n, at + sign * step * Vector::Unit(i), before).history.dissipated;
    };
    slope[i] = (dissipated(1.0) - dissipated(-1.0)) / (2.0 * step);
  }
  return slope;
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
  for (const std::string_view mode : rules_of(GetParam())) {
    const InterfaceLaw law = interface_with(GetParam(), mode, 0.8, 2.3);
    const InterfaceStrength glue = glue_for(mode);
    const Vector end = 1.3 * length() * (0.8 * n + 0.6 * s);
    double work = 0.0;
    constexpr int steps = 40000;
    InterfaceHistory history;
    InterfaceResponse last = law.respond(glue, n, Vector::Zero(), history);
    for (int i = 1; i <= steps; ++i) {
      const InterfaceResponse now = law.respond(glue, n, double(i) / steps * end, history);
      work += 0.5 * (now.traction + last.traction).dot(end) / steps;
      history = now.history;
      last = now;
    }
    EXPECT_NEAR(last.stored + last.history.dissipated, work, 1e-4 * work) << mode;
    const InterfaceResponse at_once = law.respond(glue, n, end, {});
    EXPECT_NEAR(at_once.history.dissipated, last.history.dissipated, 1e-10 * work) << mode;
  }
}

TEST_P(InterfaceOfLaw, TangentIsTheDerivative) {
  for (const std::string_view mode : rules_of(GetParam())) {
    InterfaceLaw law = interface_with(GetParam(), mode, 0.8, 2.3);
    law.friction = 0.4;
    const InterfaceStrength glue = glue_for(mode);
    const InterfaceHistory broken = law.respond(glue, n, 0.41 * length() * (0.8 * n + 0.6 * s), {}).history;
    for (const InterfaceHistory& before : {InterfaceHistory{}, broken})
      for (const double size : {0.002, 0.3, 0.9})
        for (const Vector& direction : {Vector(0.8 * n + 0.6 * s), Vector(-0.05 * n + s), Vector(-0.6 * n + 0.8 * s),
                                        Vector(n + 0.01 * s), Vector(0.3 * n + 0.9 * s)}) {
          const Vector at = size * length() * direction;
          const InterfaceResponse response = law.respond(glue, n, at, before);
          const Tensor tangent = differences(law, glue, at, before, 1e-6 * at.norm());
          EXPECT_LT((response.tangent - tangent).norm(), 1e-6 * law.initial_stiffness(glue))
              << mode << " " << size << " " << direction.transpose();
          const Vector slope = dissipation_differences(law, glue, at, before, 1e-6 * at.norm());
          EXPECT_LT((response.dissipation_slope - slope).norm(), 1e-6 * glue.toughness / at.norm())
              << mode << " " << size << " " << direction.transpose();
          EXPECT_LT((response.secant - response.secant.transpose()).norm(), 1e-12 * law.initial_stiffness(glue));
        }
  }
}

// Where the mode changes on the way, the sum over the steps tends to the work that is not stored, the second order in
// the step; here the work by so fine a path that its own error does not count.
struct Turn {
  std::string_view what;
  std::vector<Vector> corners;  // over toughness/strength
  double friction;
};

std::vector<Turn> turns() {
  const Vector b = n.cross(s);
  return {{"from opening to shear", {0.001 * n, 0.35 * n + 0.02 * s, 0.5 * n + 0.5 * s, 0.2 * n + 1.2 * s}, 0.0},
          {"from shear to opening", {0.001 * s, 0.3 * s + 0.02 * n, 0.4 * s + 0.4 * n, 0.1 * s + 1.1 * n}, 0.0},
          {"broken, closed and rubbed",
           {0.001 * n, 0.3 * n, 0.02 * s - 1e-3 * n, 0.6 * s - 2e-3 * n, 0.9 * s + 0.5 * b - 1e-3 * n},
           0.4}};
}

// On a smooth curve through the corners (Catmull and Rom's), tau from 0 to 1.
Vector on_curve(const std::vector<Vector>& corners, double tau) {
  const double place = tau * static_cast<double>(corners.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), corners.size() - 2);
  const double x = place - static_cast<double>(i);
  const Vector &p1 = corners[i], &p2 = corners[i + 1];
  const Vector p0 = i > 0 ? corners[i - 1] : Vector(2.0 * p1 - p2);
  const Vector p3 = i + 2 < corners.size() ? corners[i + 2] : Vector(2.0 * p2 - p1);
  return p1 + 0.5 * x * ((p2 - p0) + x * ((2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) + x * (3.0 * (p1 - p2) + p3 - p0)));
}

struct Account {
  double work, stored, dissipated;  // [J/m^2]
};

Account account_of(const InterfaceLaw& law, const InterfaceStrength& glue, const Turn& turn, int steps) {
  const double length = glue.toughness / glue.strength;
  InterfaceResponse last = law.respond(glue, n, Vector::Zero(), {});
  Vector at = Vector::Zero();
  double work = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const Vector next = length * on_curve(turn.corners, double(i) / steps);
    const InterfaceResponse now = law.respond(glue, n, next, last.history);
    work += 0.5 * (now.traction + last.traction).dot(next - at);
    at = next, last = now;
  }
  return {work, last.stored, last.history.dissipated + last.history.rubbed};
}

TEST_P(InterfaceOfLaw, DissipatesToSecondOrderWhereTheModeTurns) {
  for (const std::string_view mode : rules_of(GetParam()))
    for (const Turn& turn : turns()) {
      SCOPED_TRACE(testing::Message() << mode << ", " << turn.what);
      InterfaceLaw law = interface_with(GetParam(), mode, 0.6, 1.5);
      law.friction = turn.friction;
      const InterfaceStrength glue = glue_for(mode);
      const Account fine = account_of(law, glue, turn, 48000);
      EXPECT_NEAR(fine.stored + fine.dissipated, fine.work, 2e-4 * fine.work);
      const auto error = [&](int steps) {
        return std::abs(account_of(law, glue, turn, steps).dissipated / fine.dissipated - 1.0);
      };
      EXPECT_LT(error(12), 4e-2);
      EXPECT_LT(error(48), 2e-3);
      EXPECT_LT(error(192), 2e-4);
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
