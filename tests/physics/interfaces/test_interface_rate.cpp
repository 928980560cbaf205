#include "physics/interfaces/interface_rate.h"

#include "tests/physics/glued_interfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pfdm::this_file {
namespace {

using namespace glued_interfaces;

constexpr double v_0 = 1e-3;  // [m/s]

InterfaceRate rate_of(const InterfaceRateLaw& law) { return {.law = &law, .p = {0.3, v_0}}; }

class InterfaceRates : public testing::TestWithParam<InterfaceRateLaw> {};

TEST_P(InterfaceRates, AreZeroAtRestAndHaveTheirSlope) {
  const InterfaceRate rate = rate_of(GetParam());
  EXPECT_EQ(rate.at(0.0).value, 0.0);
  EXPECT_EQ(rate.at(-v_0).value, 0.0);
  EXPECT_EQ(rate.at(-v_0).slope, 0.0);
  EXPECT_EQ(rate.rate_of(0.0), 0.0);
  for (const double v : {1e-16, 1e-9, 1e-5, 1e-3, 10.0}) {
    const double change = 1e-5 * v, slope = (rate.at(v + change).value - rate.at(v - change).value) / (2.0 * change);
    EXPECT_NEAR(rate.at(v).slope, slope, 1e-6 * slope) << v;
    EXPECT_GT(rate.at(1.1 * v).value, rate.at(v).value);
    EXPECT_NEAR(rate.rate_of(rate.at(v).value), v, 1e-9 * v);
  }
}

// At rest the separation does not tell r: the traction is that of a given one, the same as at its rate.
TEST_P(InterfaceRates, PullAsAGivenOverstressSays) {
  InterfaceLaw law = interface_with(law_named("linear"), "camacho_ortiz", 0.7);
  law.rate = rate_of(GetParam());
  constexpr double duration = 1e-2;
  const double length = glued.toughness / glued.strength;
  const InterfaceHistory before = law.respond(glued, n, 0.3 * length * n, {}, duration).history;
  const Vector delta = length * (0.35 * n + 0.2 * s);
  const double r = law.rate.at(law.growth(n, delta, before) / duration).value;
  const InterfaceResponse by_rate = law.respond(glued, n, delta, before, duration),
                          given = law.respond(glued, n, delta, before, duration, r),
                          more = law.respond(glued, n, delta, before, duration, r + 0.1);
  EXPECT_LT((given.traction - by_rate.traction).norm(), 1e-12 * glued.strength);
  EXPECT_LT((given.tangent - by_rate.tangent).norm(), 1e-8 * by_rate.tangent.norm());
  EXPECT_LT((given.traction + 0.1 * given.by_overstress - more.traction).norm(), 1e-12 * glued.strength);
  EXPECT_EQ(more.history.overstress, r + 0.1);
  const double step = 1e-6 * length;
  for (int i = 0; i < 3; ++i) {
    const Vector d = step * Vector::Unit(i);
    const auto overstress = [&](const Vector& at) {
      return law.respond(glued, n, at, before, duration).history.overstress;
    };
    EXPECT_NEAR(given.overstress_slope[i], (overstress(delta + d) - overstress(delta - d)) / (2.0 * step),
                1e-6 / length);
  }
}

TEST_P(InterfaceRates, MultiplyTheTractionOfAConstantRate) {
  InterfaceLaw slow = interface_with(law_named("linear"), "camacho_ortiz"), law = slow;
  law.rate = rate_of(GetParam());
  constexpr double rate = 4e-3;
  constexpr int steps = 7;
  const double r = law.rate.at(rate).value, end = 0.9 * glued.toughness / glued.strength;
  InterfaceHistory history, slow_history;
  for (int i = 1; i <= steps; ++i) {
    const Vector delta = end * i / steps * n;
    const InterfaceResponse now = law.respond(glued, n, delta, history, end / steps / rate);
    const InterfaceResponse of_slow = slow.respond(glued, n, delta, slow_history);
    EXPECT_LT((now.traction - (1.0 + r) * of_slow.traction).norm(), 1e-12 * glued.strength);
    EXPECT_EQ(now.stored, of_slow.stored);
    EXPECT_EQ(now.history.dissipated, of_slow.history.dissipated);
    history = now.history, slow_history = of_slow.history;
    EXPECT_LT((law.respond(glued, n, delta, history).traction - now.traction).norm(), 1e-12 * glued.strength);
  }
  // The first step begins at rest.
  const double first = slow.respond(glued, n, end / steps * n, {}).history.dissipated +
                       slow.respond(glued, n, end / steps * n, {}).stored;
  const double work =
      slow.respond(glued, n, end * n, {}).history.dissipated + slow.respond(glued, n, end * n, {}).stored;
  EXPECT_NEAR(history.viscous, r * (work - 0.5 * first), 1e-12 * work);
}

INSTANTIATE_TEST_SUITE_P(Laws, InterfaceRates,
                         testing::ValuesIn(interface_rate_laws().begin(), interface_rate_laws().end()),
                         [](const auto& test) { return std::string(test.param.name); });

class LawWithRate : public testing::TestWithParam<TractionSeparationLaw> {
 protected:
  static double length() { return glued.toughness / glued.strength; }
};

TEST_P(LawWithRate, HasItsDerivative) {
  constexpr double duration = 1e-2;
  for (const InterfaceRateLaw& of_rate : interface_rate_laws())
    for (const std::string_view mode : rules_of(GetParam())) {
      InterfaceLaw law = interface_with(GetParam(), mode, 0.8, 2.3);
      law.friction = 0.4;
      law.rate = rate_of(of_rate);
      const InterfaceStrength glue = glue_for(mode);
      const InterfaceHistory broken = law.respond(glue, n, 0.41 * length() * (0.8 * n + 0.6 * s), {}, duration).history;
      for (const InterfaceHistory& before : {InterfaceHistory{}, broken})
        for (const double size : {0.002, 0.3, 0.9})
          for (const Vector& direction : {Vector(0.8 * n + 0.6 * s), Vector(-0.05 * n + s), Vector(n + 0.01 * s)}) {
            const Vector at = size * length() * direction;
            const InterfaceResponse response = law.respond(glue, n, at, before, duration);
            Tensor tangent;
            const double step = 1e-6 * at.norm();
            for (int i = 0; i < 3; ++i) {
              const Vector d = step * Vector::Unit(i);
              tangent.col(i) = (law.respond(glue, n, at + d, before, duration).traction -
                                law.respond(glue, n, at - d, before, duration).traction) /
                               (2.0 * step);
            }
            EXPECT_LT((response.tangent - tangent).norm(), 1e-6 * response.tangent.norm() + 1e-6 * glue.stiffness)
                << mode << " " << size << " " << direction.transpose();
          }
    }
}

// In mixed mode, at a rate that changes.
TEST_P(LawWithRate, StoresOrDissipatesTheWork) {
  for (const std::string_view mode : rules_of(GetParam())) {
    InterfaceLaw law = interface_with(GetParam(), mode, 0.8, 2.3);
    law.rate = rate_of(interface_rate_laws().front());
    const InterfaceStrength glue = glue_for(mode);
    const auto left_over = [&](int steps) {
      double work = 0.0;
      InterfaceHistory history;
      Vector before = Vector::Zero(), traction = Vector::Zero();
      InterfaceResponse now;
      for (int i = 1; i <= steps; ++i) {
        const double x = double(i) / steps, size = 1.1 * length() * x * x * (1.4 - 0.4 * x);
        const Vector delta = size * ((0.8 - 0.2 * x) * n + 0.6 * x * s);
        now = law.respond(glue, n, delta, history, 0.02 / steps);
        work += 0.5 * (now.traction + traction).dot(delta - before);
        history = now.history, before = delta, traction = now.traction;
      }
      EXPECT_GT(history.viscous, 0.1 * work);
      return std::abs(now.stored + history.dissipated + history.viscous - work) / work;
    };
    EXPECT_LT(left_over(4000), 1e-3) << mode;
    EXPECT_LT(left_over(4000), 0.6 * left_over(1000) + 1e-6) << mode;
  }
}

TEST_P(LawWithRate, UnloadsAsWithoutIt) {
  InterfaceLaw slow = interface_with(GetParam(), "camacho_ortiz", 0.7), law = slow;
  law.rate = rate_of(interface_rate_laws().front());
  const Vector far = length() * (0.8 * n + 0.5 * s);
  const InterfaceResponse opened = law.respond(glued, n, far, {}, 0.01), slowly = slow.respond(glued, n, far, {});
  for (const double part : {0.9, 0.3, -0.1}) {
    const InterfaceResponse back = law.respond(glued, n, part * far, opened.history, 0.01);
    EXPECT_EQ(back.traction, slow.respond(glued, n, part * far, slowly.history).traction);
    EXPECT_EQ(back.history.viscous, opened.history.viscous);
    EXPECT_EQ(back.history.overstress, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, LawWithRate, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
