#include "physics/interfaces/interface_branches.h"

#include "tests/physics/glued_interfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pfdm::this_file {
namespace {

using namespace glued_interfaces;

constexpr double stiff = 4e11;  // [Pa/m]

InterfaceLaw with_branches(const TractionSeparationLaw& law, std::string_view mode) {
  InterfaceLaw with = interface_with(law, mode, 0.8, 2.3);
  with.branches = {{.stiffness = stiff, .time = 3e-3}, {.stiffness = 0.2 * stiff, .time = 0.1}};
  return with;
}

// A bond that holds, opened at a constant rate, then held: q = K v tau (1 - exp(-t/tau)), whatever the steps.
TEST(InterfaceBranches, AreExactForAConstantRate) {
  const InterfaceLaw law = with_branches(law_named("linear"), "camacho_ortiz");
  const double end = 0.5 * glued.strength / glued.stiffness, time = 0.02, rate = end / time;
  InterfaceHistory history;
  InterfaceResponse now;
  for (int i = 1; i <= 3; ++i) {
    now = law.respond(glued, n, end * i / 3.0 * n, history, time / 3.0);
    history = now.history;
  }
  double due = glued.stiffness * end, stored = 0.5 * glued.stiffness * end * end, viscous = 0.0;
  for (const auto& [K, tau] : law.branches) {
    const double x = time / tau, q = K * rate * tau * (1.0 - std::exp(-x));
    due += q;
    stored += 0.5 * q * q / K;
    viscous += K * rate * rate * tau * tau * (x + 2.0 * std::exp(-x) - 0.5 * std::exp(-2.0 * x) - 1.5);
  }
  EXPECT_NEAR(now.traction.dot(n), due, 1e-12 * due);
  EXPECT_NEAR(now.stored, stored, 1e-12 * stored);
  EXPECT_NEAR(history.viscous, viscous, 1e-12 * stored);
  EXPECT_EQ(law.respond(glued, n, end * n, history).traction, now.traction);
  const InterfaceResponse held = law.respond(glued, n, end * n, history, 100.0);
  EXPECT_NEAR(held.traction.dot(n), glued.stiffness * end, 1e-12 * due);
  EXPECT_NEAR(held.history.viscous, history.viscous + now.stored - held.stored, 1e-12 * stored);
}

class LawWithBranches : public testing::TestWithParam<TractionSeparationLaw> {
 protected:
  static double length() { return glued.toughness / glued.strength; }
};

TEST_P(LawWithBranches, HasItsDerivative) {
  constexpr double duration = 1e-2;
  for (const std::string_view mode : rules_of(GetParam())) {
    InterfaceLaw law = with_branches(GetParam(), mode);
    law.friction = 0.4;
    law.rate = {.law = &interface_rate_laws().back(), .p = {0.3, 1e-3}};
    const InterfaceStrength glue = glue_for(mode);
    const InterfaceHistory broken = law.respond(glue, n, 0.41 * length() * (0.8 * n + 0.6 * s), {}, duration).history;
    for (const double size : {0.002, 0.3, 0.9})
      for (const Vector& direction : {Vector(0.8 * n + 0.6 * s), Vector(-0.05 * n + s), Vector(n + 0.01 * s)}) {
        const Vector at = size * length() * direction;
        Tensor tangent;
        for (int i = 0; i < 3; ++i) {
          const Vector d = 1e-6 * at.norm() * Vector::Unit(i);
          tangent.col(i) = (law.respond(glue, n, at + d, broken, duration).traction -
                            law.respond(glue, n, at - d, broken, duration).traction) /
                           (2e-6 * at.norm());
        }
        const InterfaceResponse response = law.respond(glue, n, at, broken, duration);
        EXPECT_LT((response.tangent - tangent).norm(), 1e-6 * (response.tangent.norm() + glue.stiffness))
            << mode << " " << size << " " << direction.transpose();
      }
  }
}

TEST_P(LawWithBranches, StoresOrDissipatesTheWorkAndVanishes) {
  for (const std::string_view mode : rules_of(GetParam())) {
    const InterfaceLaw law = with_branches(GetParam(), mode);
    const InterfaceStrength glue = glue_for(mode);
    constexpr int steps = 5000;
    double work = 0.0;
    InterfaceHistory history;
    Vector before = Vector::Zero(), traction = Vector::Zero();
    InterfaceResponse now;
    for (int i = 1; i <= steps; ++i) {
      const double x = double(i) / steps, size = 40.0 * length() * x * x;
      const Vector delta = size * ((0.8 - 0.2 * x) * n + 0.6 * x * s);
      now = law.respond(glue, n, delta, history, 0.02 / steps);
      work += 0.5 * (now.traction + traction).dot(delta - before);
      EXPECT_GE(now.history.viscous, history.viscous);
      history = now.history, before = delta, traction = now.traction;
    }
    EXPECT_GT(history.viscous, 0.01 * work);
    EXPECT_NEAR(now.stored + history.dissipated + history.viscous, work, 1e-3 * work) << mode;
    if (GetParam().name == "linear") {
      EXPECT_EQ(now.traction, Vector::Zero());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, LawWithBranches, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
