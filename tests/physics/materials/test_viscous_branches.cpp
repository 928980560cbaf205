// Maxwell branches at finite strain (physics/materials/viscous_branches.h) against their differential equation, solved
// in small steps by Runge and Kutta's method of fourth order, and against their limits.

#include "physics/materials/hyperelastic.h"
#include "physics/materials/viscous_branches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pfdm::test_viscous_branches {
namespace {

const std::vector<PronyBranch> two{{.modulus = 0.7e6, .time = 0.3}, {.modulus = 0.2e6, .time = 2.0}};

const std::vector<PronyBranch> bulk{{.modulus = 1.5e6, .time = 0.5}};

// A path that stretches, shears and turns [-].
Tensor gradient_at(double t) {
  Tensor H;
  H << 0.5 * t, 0.4 * t * t, 0.1 * t, -0.2 * t, -0.2 * t, 0.3 * t, 0.05 * t, 0.1 * t * t, 0.15 * t;
  const double angle = 0.8 * t;
  Tensor R;
  R << std::cos(angle), -std::sin(angle), 0.0, std::sin(angle), std::cos(angle), 0.0, 0.0, 0.0, 1.0;
  return R * (Tensor::Identity() + H) - Tensor::Identity();
}

struct Exact {
  Tensor stress = Tensor::Zero();
  double energy = 0.0, heat = 0.0;
};

// The bulk branch likewise: v' = (ln J - v)/tau of v = ln J_v, W = K/2 (J_e - 1)^2.
void add_bulk(int steps, Exact& sum) {
  const auto [K, tau] = bulk[0];
  const auto volume = [](double t) { return (Tensor::Identity() + gradient_at(t)).determinant(); };
  const auto heat = [&, K = K, tau = tau](double t, double v) {
    const double J_e = volume(t) / std::exp(v);
    return K * J_e * (J_e - 1.0) * std::log(J_e) / tau;
  };
  const auto rate = [&, tau = tau](double t, double v) { return (std::log(volume(t)) - v) / tau; };
  double v = 0.0;
  const double dt = 1.0 / steps;
  for (int k = 0; k < steps; ++k) {
    const double t = k * dt, a = rate(t, v), b = rate(t + 0.5 * dt, v + 0.5 * dt * a),
                 c = rate(t + 0.5 * dt, v + 0.5 * dt * b), d = rate(t + dt, v + dt * c);
    const double next = v + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    sum.heat += dt / 6.0 * (heat(t, v) + 4.0 * heat(t + 0.5 * dt, v + 0.5 * dt * b) + heat(t + dt, next));
    v = next;
  }
  const Tensor F = Tensor::Identity() + gradient_at(1.0);
  const double J_e = F.determinant() / std::exp(v);
  sum.stress += K * J_e * (J_e - 1.0) * F.inverse().transpose();
  sum.energy += 0.5 * K * (J_e - 1.0) * (J_e - 1.0);
}

// The branches at t = 1 [s] by their equations, dissipation as mu/(2 tau) J^(2/3) (A:A - (tr A)^2/3), A = C' Cv^-1.
Exact exact(int steps) {
  Exact sum;
  for (const PronyBranch& branch : two) {
    struct Rate {
      Tensor Cv;
      double heat;
    };
    const auto rate = [&](double t, const Tensor& Cv) -> Rate {
      const Tensor F = Tensor::Identity() + gradient_at(t), C = F.transpose() * F;
      const double J = F.determinant();
      const Tensor isochoric = std::pow(J, -2.0 / 3.0) * C, A = isochoric * Cv.inverse();
      const double dissipated =
          0.5 * branch.modulus / branch.time * std::pow(J, 2.0 / 3.0) * ((A * A).trace() - A.trace() * A.trace() / 3.0);
      return {(isochoric - A.trace() / 3.0 * Cv) / branch.time, dissipated};
    };
    Tensor Cv = Tensor::Identity();
    const double dt = 1.0 / steps;
    for (int k = 0; k < steps; ++k) {
      const double t = k * dt;
      const Rate a = rate(t, Cv), b = rate(t + 0.5 * dt, Cv + 0.5 * dt * a.Cv),
                 c = rate(t + 0.5 * dt, Cv + 0.5 * dt * b.Cv), d = rate(t + dt, Cv + dt * c.Cv);
      Cv += dt / 6.0 * (a.Cv + 2.0 * b.Cv + 2.0 * c.Cv + d.Cv);
      sum.heat += dt / 6.0 * (a.heat + 2.0 * b.heat + 2.0 * c.heat + d.heat);
    }
    const Tensor F = Tensor::Identity() + gradient_at(1.0);
    const double size = std::pow(F.determinant(), 2.0 / 3.0);
    sum.stress += branch.modulus * (F * Cv.inverse() - size * F.inverse().transpose());
    sum.energy += 0.5 * branch.modulus * ((F.transpose() * F * Cv.inverse()).trace() - 3.0 * size);
  }
  add_bulk(steps, sum);
  return sum;
}

struct Stepped {
  PotentialAt at;
  std::vector<double> history;
};

Stepped stepped(const ViscousBranches& branches, int steps) {
  Stepped result;
  std::vector<double> before(branches.size(), 0.0);
  result.history = before;
  for (int k = 0; k < steps; ++k) {
    const PointBefore from{gradient_at(k / double(steps)), 1.0 / steps, before};
    const Tensor H = gradient_at((k + 1) / double(steps));
    result.at = branches.over(H, from);
    branches.advance(H, from, result.history);
    before = result.history;
  }
  return result;
}

TEST(ViscousBranches, AreOfSecondOrderAboutTheirEquation) {
  const ViscousBranches branches(two, VolumetricForm::quadratic, 0.0, bulk);
  const Exact due = exact(4000);
  std::vector<double> of_stress, of_energy, of_heat;
  for (const int steps : {20, 40, 80}) {
    const Stepped found = stepped(branches, steps);
    of_stress.push_back((found.at.stress - due.stress).norm() / due.stress.norm());
    of_energy.push_back(std::abs(found.at.energy - due.energy) / due.energy);
    of_heat.push_back(std::abs(branches.heat(found.history) - due.heat) / due.heat);
  }
  for (const auto& errors : {of_stress, of_energy}) {
    EXPECT_LT(errors[2], 4e-4);
    EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.6);
    EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.4);
  }
  EXPECT_LT(of_heat[0], 2e-3);
  EXPECT_LT(of_heat[1], of_heat[0] / 3.4);
  EXPECT_LT(of_heat[2], of_heat[1] / 3.6);
}

// What is strained at once makes none, and makes all that it has stored once it is held.
TEST(ViscousBranches, MakeHeatByRelaxingAlone) {
  const ViscousBranches branches(two, VolumetricForm::quadratic, 2.5, bulk);
  const std::vector<double> virgin(branches.size(), 0.0);
  for (const double part : {1e-3, 0.1, 1.0, 2.0}) {
    const Tensor H = gradient_at(part);
    std::vector<double> strained = virgin;
    branches.advance(H, {Tensor::Zero(), 1e-9, virgin}, strained);
    const double stored = branches.over(H, {H, 0.0, strained}).energy;
    EXPECT_GE(branches.heat(strained), 0.0);
    EXPECT_LT(branches.heat(strained), 1e-6 * stored);
    std::vector<double> held = strained;
    branches.advance(H, {H, 1e9, strained}, held);
    EXPECT_NEAR(branches.heat(held), stored, 1e-6 * stored) << part;
  }
}

TEST(ViscousBranches, HaveTheTangentOfTheirStep) {
  for (const double bulk_ratio : {0.0, 2.5}) {
    const ViscousBranches branches(two, VolumetricForm::logarithmic, bulk_ratio, bulk);
    const std::vector<double> history = stepped(branches, 3).history;
    const PointBefore before{gradient_at(1.0), 0.4, history};
    const Tensor H = gradient_at(1.3);
    const GradientTangent tangent = branches.over(H, before).tangent;
    constexpr double step = 1e-6;
    for (Index k = 0; k < 9; ++k) {
      const Tensor by = step * from_components(Components::Unit(k));
      const Components due =
          to_components(branches.over(H + by, before).stress - branches.over(H - by, before).stress) / (2.0 * step);
      EXPECT_LT((tangent.col(k) - due).norm(), 1e-8 * tangent.norm()) << k << ' ' << bulk_ratio;
    }
  }
}

TEST(ViscousBranches, AreAPronySeriesAtSmallStrain) {
  const ViscousBranches branches(two, VolumetricForm::quadratic, 0.0, bulk);
  const IsotropicElasticity relaxed = from_young_poisson(1e6, 0.3);
  const auto prony = make_prony({.relaxed = relaxed, .shear = two, .bulk = bulk});
  constexpr double small = 1e-6;
  std::vector<double> of_branches(branches.size(), 0.0), of_prony(prony->history_size(), 0.0);
  Tensor from = Tensor::Zero();
  constexpr double dt = 0.1;
  for (int k = 1; k <= 60; ++k) {
    const Tensor H = small * symmetric_part(gradient_at(0.02 * k));
    const std::vector<double> b = of_branches, p = of_prony;
    const Tensor stress = branches.over(H, {from, dt, b}).stress;
    branches.advance(H, {from, dt, b}, of_branches);
    const Tensor due = prony->update({from, H, dt, p}, of_prony).stress - pfdm::stress(relaxed, H);
    EXPECT_LT((stress - due).norm(), 20.0 * small * due.norm());
    from = H;
  }
  EXPECT_NEAR(branches.heat(of_branches), of_prony.back(), 20.0 * small * of_prony.back());
}

TEST(ViscousBranches, MakeNoStressOrHeatByTurning) {
  const ViscousBranches branches(two, VolumetricForm::quadratic, 2.5);
  const std::vector<double> history = stepped(branches, 4).history;
  const Tensor F = Tensor::Identity() + gradient_at(1.0), R = Tensor::Identity() + [] {
    Tensor turn;
    turn << -2.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, -1.0, -1.0;
    return turn;
  }();
  ASSERT_NEAR((R * R.transpose() - Tensor::Identity()).norm(), 0.0, 1e-14);
  const Tensor turned = R * F - Tensor::Identity();
  const PointBefore before{gradient_at(1.0), 0.1, history};
  const Tensor as_it_was = branches.over(gradient_at(1.0), before).stress;
  EXPECT_LT((branches.over(turned, before).stress - R * as_it_was).norm(), 1e-12 * as_it_was.norm());
  std::vector<double> unturned_history = history, turned_history = history;
  branches.advance(gradient_at(1.0), before, unturned_history);
  branches.advance(turned, before, turned_history);
  EXPECT_NEAR(branches.heat(turned_history), branches.heat(unturned_history), 1e-10 * branches.heat(history));
}

TEST(ViscousBranches, AreRubberAtOnceAndNothingAtLast) {
  const ViscousBranches branches(two, VolumetricForm::quadratic, 0.0);
  const std::vector<double> virgin(branches.size(), 0.0);
  const Tensor H = gradient_at(1.0), F = Tensor::Identity() + H;
  const double mu = two[0].modulus + two[1].modulus, size = std::pow(F.determinant(), 2.0 / 3.0);
  const Tensor at_once = branches.over(H, {Tensor::Zero(), 1e-12, virgin}).stress;
  EXPECT_LT((at_once - mu * (F - size * F.inverse().transpose())).norm(), 1e-9 * at_once.norm());
  const Tensor held = branches.over(H, {H, 1e4, stepped(branches, 3).history}).stress;
  EXPECT_LT(held.norm(), 1e-3 * at_once.norm());
}

TEST(ViscousBranches, StayFiniteAndSmoothWhereACellTurnsInsideOut) {
  const ViscousBranches branches(two, VolumetricForm::logarithmic, 2.5, bulk);
  const std::vector<double> history = stepped(branches, 3).history;
  const PointBefore before{gradient_at(1.0), 0.3, history};
  for (double squeeze = 0.5; squeeze < 2.2; squeeze += 0.05) {
    const Tensor H =
        (Tensor::Identity() + gradient_at(1.0)) * Vector(1.0, 1.0 - squeeze, 1.0).asDiagonal() - Tensor::Identity();
    const PotentialAt at = branches.over(H, before);
    ASSERT_TRUE(std::isfinite(at.energy) && at.stress.allFinite() && at.tangent.allFinite()) << squeeze;
    constexpr double step = 1e-6;
    const Tensor by = step * from_components(Components::Unit(4));
    const Tensor due = (branches.over(H + by, before).stress - branches.over(H - by, before).stress) / (2.0 * step);
    EXPECT_LT((at.tangent.col(4) - to_components(due)).norm(), 1e-6 * at.tangent.norm()) << squeeze;
    std::vector<double> after = history;
    branches.advance(H, before, after);
    for (const double number : after) ASSERT_TRUE(std::isfinite(number));
  }
}

TEST(ViscousBranches, AreRefusedWhereTheyMakeNoSense) {
  const HyperelasticParameters p{.elasticity = from_young_poisson(1e6, 0.3),
                                 .branches = {{.modulus = -1.0, .time = 1.0}}};
  EXPECT_ANY_THROW(make_hyperelastic("neo_hookean", p));
  EXPECT_ANY_THROW(make_hyperelastic("saint_venant_kirchhoff", {.elasticity = p.elasticity, .branches = two}));
}

}  // namespace
}  // namespace pfdm::test_viscous_branches
