#include "physics/interfaces/interface_law.h"
#include "physics/registry.h"
#include "tests/physics/glued_interfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm::this_file {
namespace {

using namespace glued_interfaces;

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

}  // namespace
}  // namespace pfdm::this_file
