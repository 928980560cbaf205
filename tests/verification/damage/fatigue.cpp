// Fatigue of a uniform body under cycles of strain against the equations of Carrara et al. (CMAME 361 (2020) 112731),
// integrated at a point: by the scheme of the program (f of the step's start), and with small steps.

#include "solver/fracture/damage/damage_equation.h"
#include "solver/fracture/fracture_run.h"
#include "solver/parallel.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double E = 30e9, Gc = 100.0, ell = 5e-3, side = 10e-3, threshold = 2e3;
constexpr double peak_strain = 3e-4;  // 0.6 of the elastic limit of AT1

double strain_at(double t) {
  const double s = std::sin(std::numbers::pi * t);
  return peak_strain * s * s;
}

struct Row {
  double damage = 0.0, energy = 0.0;  // d [-], alpha_bar [J/m^3]
  double imbalance = 0.0;             // of work and energies, over the work
  double cycles = 0.0;
};

/// A law of fatigue as it is published, with its row in the program.
struct Law {
  std::string name;
  LawParameters p{};
  double factor(double x) const {
    if (x <= 1.0) return 1.0;
    if (name == "asymptotic") return 4.0 / ((x + 1.0) * (x + 1.0));
    return x < std::pow(10.0, 1.0 / p[0]) ? std::pow(1.0 - p[0] * std::log10(x), 2.0) : 0.0;
  }
};
const Law asymptotic{"asymptotic", {}}, logarithmic{"logarithmic", {0.9}};

/// At a point, f being that of the step's start: f Gc/(c0 ell) alpha'(d) = 2 (1 - d) psi, d never falls.
Row integrate(const std::string& crack, const Law& law, double cycles, Index steps_per_cycle) {
  Row row;
  double active = 0.0;
  const auto n = static_cast<Index>(std::lround(cycles * double(steps_per_cycle)));
  for (Index i = 1; i <= n; ++i) {
    const double eps = strain_at(double(i) / double(steps_per_cycle)), psi = 0.5 * E * eps * eps;
    const double tough = law.factor(row.energy / threshold) * Gc / ell;
    double d = 0.0;
    if (psi > 0.0) d = crack == "AT1" ? 1.0 - 3.0 / 16.0 * tough / psi : 2.0 * psi / (2.0 * psi + tough);
    row.damage = std::clamp(d, row.damage, 1.0);
    const double now = (1.0 - row.damage) * (1.0 - row.damage) * psi;
    row.energy += std::max(now - active, 0.0);
    active = now;
  }
  return row;
}

struct Plate {
  std::string crack = "AT1";
  std::optional<Law> law{};
  FatigueCycles cycles{};
  double alpha_T = threshold;
  Index cells = 1;
  double weakness = 0.0;  // of the toughness of the cells of one half
  bool is_monotonic = false;
};

FractureModel model_of(const Plate& plate, const Mesh& mesh) {
  FractureModel model =
      elastic_model({}, {symmetry_on("xmin"), symmetry_on("ymin"), plane_on("zmin"), plane_on("zmax")});
  model.crack = &crack_geometry(plate.crack);
  model.regions = {{.elasticity = from_young_poisson(E, 0.0), .Gc = Gc, .ell = ell}};
  if (plate.law) model.regions[0].fatigue = Fatigue(fatigue_law(plate.law->name), plate.alpha_T, plate.law->p);
  model.fatigue_cycles = plate.cycles;
  model.residual_stiffness = 1e-12;
  model.boundary.push_back(moved("xmax", {true, false, false}, [&plate](const Vector&, double t) {
    return Vector((plate.is_monotonic ? 3.0 * peak_strain * t : strain_at(t)) * side, 0.0, 0.0);
  }));
  if (plate.weakness == 0.0) return model;
  model.cells = CellField<RegionModel>(mesh.n_cells(), model.regions[0]);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c][0] > 0.5 * side) model.cells[c].Gc *= 1.0 - plate.weakness;
  return model;
}

struct Outcome {
  FractureState state;
  std::vector<Row> rows;
  std::vector<EnergyAccount> accounts;
};

Outcome stretch(const Plate& plate, double cycles, Index steps_per_cycle, double tolerance = 1e-10) {
  const Index n = plate.cells;
  const Mesh mesh = make_box_hexes(
      {.axes = {{{{side, n, 1.0}}, {{side, n, 1.0}}, {{side / double(n), 1, 1.0}}}}, .regions = {}, .slits = {}});
  const double increment = 1.0 / double(steps_per_cycle);
  FractureRun run(mesh, model_of(plate, mesh),
                  {.damage_tolerance = tolerance, .energy_tolerance = tolerance, .maximum_iterations = 5000},
                  {.end = cycles, .initial_increment = increment, .maximum_increment = increment, .stops = {}});
  Outcome outcome;
  outcome.state = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.step == 0) return;
    for (const std::string& remark : report.remarks) EXPECT_EQ(remark.find("converge"), remark.npos) << remark;
    const EnergyAccount& e = report.energy;
    outcome.accounts.push_back(e);
    outcome.rows.push_back({.damage = report.max_damage,
                            .energy = plate.law ? state.fatigue.energy[0] : 0.0,
                            .imbalance = (e.external_work - e.elastic - e.fracture) / e.external_work,
                            .cycles = state.load});
  });
  return outcome;
}

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
        error = std::max(error, std::abs(rows[as_size((i + 1) * n / times - 1)].damage - exact[as_size(i)]));
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
    Plate tires = plain;
    tires.law = asymptotic, tires.alpha_T = 1e9;
    const Outcome a = stretch(plain, 1.0, 20, 1e-6), b = stretch(tires, 1.0, 20, 1e-6);
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

// While no damage grows alpha_bar is the same as without jumps.
TEST(Fatigue, JumpsAreExactWhileTheCyclesAreAlike) {
  constexpr FatigueCycles jumping{.cycle = 1.0, .steps = 4, .jump_tolerance = 0.02};
  const Plate computed{.law = asymptotic, .alpha_T = 2e4};
  Plate jumped = computed;
  jumped.cycles = jumping;
  const Outcome a = stretch(computed, 20.0, 4), b = stretch(jumped, 20.0, 4);
  EXPECT_EQ(a.rows.back().damage, 0.0);
  EXPECT_EQ(b.rows.back().cycles, 20.0);
  EXPECT_GT(b.state.fatigue.jumped_cycles, 10.0);
  EXPECT_LT(4.0 * (20.0 - b.state.fatigue.jumped_cycles), double(b.rows.size()) + 0.5);
  EXPECT_NEAR(b.rows.back().energy, a.rows.back().energy, 1e-9 * a.rows.back().energy);
}

// With damage that grows the result comes nearer as the tolerance falls.
TEST(Fatigue, JumpsConvergeWithTheirTolerance) {
  const Plate computed{.law = asymptotic, .alpha_T = 1e5};
  const double exact = stretch(computed, 250.0, 4).rows.back().damage;
  ASSERT_GT(exact, 0.2);
  ASSERT_LT(exact, 0.8);
  std::vector<double> errors, cycles;
  for (const double tolerance : {0.04, 0.02, 0.01}) {
    Plate jumped = computed;
    jumped.cycles = {.cycle = 1.0, .steps = 4, .jump_tolerance = tolerance};
    const Outcome outcome = stretch(jumped, 250.0, 4);
    errors.push_back(std::abs(outcome.rows.back().damage - exact));
    cycles.push_back(250.0 - outcome.state.fatigue.jumped_cycles);
  }
  report_row("error of d",
             {{"0.04", errors[0]}, {"0.02", errors[1]}, {"0.01", errors[2]}, {"computed cycles", cycles[2]}});
  EXPECT_LT(errors[2], errors[0]);
  EXPECT_LT(errors[2], 0.01);
  EXPECT_LT(cycles[2], 125.0);
}

TEST(Fatigue, IsTheSameOnAnyNumberOfThreads) {
  Plate plate{.crack = "AT2", .law = asymptotic, .cells = 40, .weakness = 0.05};
  plate.cycles = {.cycle = 1.0, .steps = 2, .jump_tolerance = 0.1, .computed_cycles = 1};
  const auto end = [&](int threads) {
    set_threads(threads);
    FractureState state = stretch(plate, 6.0, 2, 1e-4).state;
    set_threads(1);
    return state;
  };
  const FractureState alone = end(1), together = end(2);
  EXPECT_GT(alone.fatigue.jumped_cycles, 0.0);
  EXPECT_TRUE(alone.damage == together.damage);
  EXPECT_TRUE(alone.displacement == together.displacement);
  EXPECT_TRUE(alone.fatigue == together.fatigue);
  EXPECT_TRUE(alone.energy == together.energy);
}

}  // namespace
}  // namespace pfdm::verification::this_file
