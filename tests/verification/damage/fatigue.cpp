// Fatigue of a uniform body under cycles of strain against the equations of Carrara et al. (CMAME 361 (2020) 112731),
// integrated at a point: by the scheme of the program (f of the step's start), and with small steps.

#include "solver/fracture/damage/damage_equation.h"
#include "tests/verification/fatigue_plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

using namespace fatigue_plate;

// The program does at a cell what the equations say, step by step.
TEST(Fatigue, OfACellIsThatOfThePoint) {
  for (const std::string crack : {"AT1", "AT2"})
    for (const Law& law : {asymptotic, logarithmic}) {
      SCOPED_TRACE(crack + ", " + law.name);
      const Outcome outcome = stretch({.crack = crack, .law = law}, 6.0, 8);
      double of_damage = 0.0, of_energy = 0.0;
      for (const Row& row : outcome.rows) {
        const Row exact = integrate(crack, law, row.cycles, 8);
        of_damage = std::max(of_damage, std::abs(row.damage - exact.damage));
        of_energy = std::max(of_energy, std::abs(row.energy - exact.energy) / threshold);
      }
      report_row(crack + ", " + law.name, {{"damage", outcome.rows.back().damage},
                                           {"alpha_bar/alpha_T", outcome.rows.back().energy / threshold},
                                           {"error of d", of_damage},
                                           {"error of alpha_bar/alpha_T", of_energy}});
      EXPECT_GT(outcome.rows.back().damage, 0.2);
      EXPECT_LT(of_damage, 1e-6);
      EXPECT_LT(of_energy, 1e-6);
    }
}

// With a history of the driving energy damage also grows while the load falls, as f does; alpha_bar is that of psi_plus
// itself.
TEST(Fatigue, OfACellWithAHistoryIsThatOfThePoint) {
  double of_damage = 0.0, of_energy = 0.0;
  const Outcome outcome = stretch({.crack = "AT2", .law = asymptotic, .history = true}, 6.0, 8);
  for (const Row& row : outcome.rows) {
    const Row exact = integrate("AT2", asymptotic, row.cycles, 8, true);
    of_damage = std::max(of_damage, std::abs(row.damage - exact.damage));
    of_energy = std::max(of_energy, std::abs(row.energy - exact.energy) / threshold);
  }
  report_row("AT2", {{"damage", outcome.rows.back().damage}, {"error of d", of_damage}, {"of alpha_bar", of_energy}});
  EXPECT_GT(outcome.rows.back().damage, integrate("AT2", asymptotic, 6.0, 8).damage + 1e-3);
  EXPECT_LT(of_damage, 1e-6);
  EXPECT_LT(of_energy, 1e-6);
}

// f is that of the step's start: a quarter of the step, a quarter of the error. Where a step crosses the threshold or
// the onset of damage matters as well, so that the order is seen over several halvings.
TEST(Fatigue, IsOfFirstOrderInTheStep) {
  constexpr Index times = 16;  // of a cycle, at which damages are compared
  for (const std::string crack : {"AT1", "AT2"}) {
    std::vector<double> exact, errors;
    for (Index i = 1; i <= 5 * times; ++i)
      exact.push_back(integrate(crack, asymptotic, double(i) / double(times), 1 << 14).damage);
    for (const Index n : {64, 256, 1024}) {
      const std::vector<Row> rows = stretch({.crack = crack, .law = asymptotic}, 5.0, n).rows;
      double error = 0.0;
      for (Index i = 0; i < 5 * times; ++i)
        error = std::max(error, std::abs(rows[(i + 1) * n / times - 1].damage - exact[i]));
      errors.push_back(error);
    }
    report_row(crack, {{"64 steps a cycle", errors[0]}, {"256", errors[1]}, {"1024", errors[2]}});
    for (const std::size_t i : {1u, 2u}) EXPECT_LT(errors[i], errors[i - 1] / 3.0);
    EXPECT_LT(errors[2], 3e-4);
  }
}

// Where the degradation is that of a cohesive law (Wu), the strength falls as the root of f.
TEST(Fatigue, LowersTheStrengthOfACohesiveLaw) {
  const double f = asymptotic.factor(3.0), ft = std::sqrt(E * Gc / (20.0 * ell));
  const Mesh mesh =
      make_box_hexes({.axes = {{{{side, 1, 1.0}}, {{side, 1, 1.0}}, {{side, 1, 1.0}}}}, .regions = {}, .slits = {}});
  FractureModel model = model_of({.crack = "Wu"}, mesh);
  model.regions[0].degradation = rational_degradation(rational_coefficients(softening_law("linear"), E, Gc, ft, ell));
  DamageEquation equation(mesh, model, Vector::Zero());
  const CellField<double> sound(1, 0.0);
  equation.set_toughness_factor(CellField<double>(1, f), sound);
  const auto damage_at = [&](double stress) {
    CellField<double> d = sound;
    equation.solve(CellField<double>(1, 0.5 * stress * stress / E), sound, {}, d);
    return d[0];
  };
  EXPECT_EQ(damage_at(0.9999 * std::sqrt(f) * ft), 0.0);
  EXPECT_GT(damage_at(1.0001 * std::sqrt(f) * ft), 0.0);
}

// Factors that vary from cell to cell are those of the toughness, on irregular prisms too.
TEST(Fatigue, FactorsAreThoseOfTheToughness) {
  const Mesh mesh = extruded_triangles(12, {0.0, 0.1});
  FractureModel plain = elastic_model({}, {});
  plain.crack = &crack_geometry("AT2");
  plain.regions = {{.elasticity = from_young_poisson(1.0, 0.0), .Gc = 1.0, .ell = 0.2}};
  FractureModel varied = plain;
  varied.cells = CellField<RegionModel>(mesh.n_cells(), plain.regions[0]);
  CellField<double> factor(mesh.n_cells()), psi(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector& x = mesh.cell_centre[c];
    factor[c] = varied.cells[c].Gc = 0.3 + 0.2 * x[0];
    psi[c] = 3.0 * x[1] * x[1];
  }
  const CellField<double> sound(mesh.n_cells(), 0.0);
  CellField<double> d = sound, expected = sound;
  DamageEquation by_factor(mesh, plain, Vector::UnitZ()), by_toughness(mesh, varied, Vector::UnitZ());
  by_factor.set_toughness_factor(factor, sound);
  by_factor.solve(psi, sound, {.corrections = 20}, d);
  by_toughness.solve(psi, sound, {.corrections = 20}, expected);
  EXPECT_GT(*std::max_element(d.begin(), d.end()), 0.5);
  for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_NEAR(d[c], expected[c], 1e-12);
  const double energy = by_toughness.renewed_fracture_energy(expected);
  EXPECT_NEAR(by_factor.renewed_fracture_energy(d), energy, 1e-12 * energy);
}

TEST(Fatigue, BelowItsThresholdChangesNoBit) {
  for (const std::string crack : {"AT1", "AT2"}) {
    const Plate plain{.crack = crack, .cells = 8, .weakness = 0.02, .is_monotonic = true};
    Plate with_fatigue = plain;
    with_fatigue.law = asymptotic, with_fatigue.alpha_T = 1e9;
    const Outcome a = stretch(plain, 1.0, 20, 1e-6), b = stretch(with_fatigue, 1.0, 20, 1e-6);
    EXPECT_GT(a.rows.back().damage, 0.3);
    EXPECT_TRUE(a.state.damage == b.state.damage);
    EXPECT_TRUE(a.state.displacement == b.state.displacement);
    EXPECT_TRUE(a.state.boundary_force == b.state.boundary_force);
    EXPECT_TRUE(a.accounts == b.accounts);
    EXPECT_GT(b.rows.back().energy, 0.0);
  }
}

// What the forces do is stored, or has been dissipated as f Gc dgamma; to the first order of the step, as f.
TEST(Fatigue, AccountsForItsEnergy) {
  for (const std::string crack : {"AT1", "AT2"}) {
    std::vector<double> errors;
    for (const Index n : {64, 256, 1024}) {
      const Outcome outcome = stretch({.crack = crack, .law = asymptotic}, 5.5, n);
      errors.push_back(std::abs(outcome.rows.back().imbalance));
      double before = 0.0;
      for (const EnergyAccount& account : outcome.accounts) {
        EXPECT_GE(account.fracture, before * (1.0 - 1e-9));  // nothing is given back
        before = account.fracture;
      }
      EXPECT_GT(before, 0.1 * outcome.accounts.back().external_work);
    }
    report_row(crack, {{"64 steps a cycle", errors[0]}, {"256", errors[1]}, {"1024", errors[2]}});
    EXPECT_LT(errors[0], 2e-3);
    EXPECT_LT(errors[2], errors[0] / 8.0);
  }
}

// Damage that grows at a peak in the only step up to it: work is missing, which is said once.
TEST(Fatigue, TellsOfMissingWork) {
  const Plate plate{.law = asymptotic};
  const Outcome coarse = stretch(plate, 8.0, 2), fine = stretch(plate, 8.0, 64);
  ASSERT_GT(coarse.rows.back().damage, 0.3);
  ASSERT_GT(fine.rows.back().damage, 0.3);
  EXPECT_EQ(coarse.lost_work, 1);
  EXPECT_EQ(fine.lost_work, 0);
}

}  // namespace
}  // namespace pfdm::verification::this_file
