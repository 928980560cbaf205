// Body forces. A column under its own weight, u = rho g (L z - z^2/2)/E at nu = 0, also of two materials; a cantilever
// under its own weight (Timoshenko's beam: w = q L^4/(8 E' I) + q L^2/(2 k mu h), k = 5/6); a ring that rotates: with
// nu = 0 u = A r + B/r - k r^3/8, k = rho w^2/E, A = 3 k (a^2 + b^2)/8, B = 3 k a^2 b^2/8 between its free radii a, b.
// At finite strain the column of Saint Venant and Kirchhoff's law, S = E (F^2 - 1)/2, F S = the weight above per
// reference area.

#include "physics/materials/hyperelastic.h"
#include "tests/verification/bar.h"
#include "tests/verification/support.h"

#include "mesh/geometry.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double E = 20e9, rho = 2400.0, g = 9.81, L = 10.0;

BoxHexesSettings column_box(Index n, double grading) {
  BoxHexesSettings box;
  box.axes = {{{{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}, {{L, n, grading}}}};
  return box;
}

std::vector<BoundaryCondition> stands() { return {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")}; }

struct Column {
  double displacement = 0.0;  // relative error, L2
  double stress = 0.0;        // likewise
  double reaction = 0.0, energy = 0.0, account = 0.0;
};

struct Solved {
  FractureState state;
  StepReport report;
  OutputFields fields;
};

Solved solve(const Mesh& mesh, const FractureModel& model, Index steps = 1) {
  const double increment = 1.0 / static_cast<double>(steps);
  FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-11},
                  {.initial_increment = increment, .maximum_increment = increment, .stops = {}});
  Solved solved;
  solved.state = run_to_end(run, [&](const FractureState&, const StepReport& report) { solved.report = report; });
  solved.fields = run.output(solved.state);
  return solved;
}

Column weigh(const Mesh& mesh, FractureModel model, const std::function<double(double)>& exact,
             const std::function<double(double)>& stress, double weight, double energy) {
  const Solved solved = solve(mesh, model);
  const auto everywhere = [](Index) { return true; };
  Column errors;
  errors.displacement = relative_error(
      mesh, [&](Index c) { return solved.fields.displacement[c]; },
      [&](Index c) { return Vector(0.0, 0.0, exact(mesh.cell_centre[c].z())); }, everywhere);
  errors.stress = relative_stress_error(
      mesh, solved.fields.stress,
      [&](const Vector& x) -> Tensor { return stress(x.z()) * Vector::UnitZ() * Vector::UnitZ().transpose(); },
      everywhere);
  const auto foot = mesh.patch_index("zmin");
  errors.reaction = solved.report.reaction[foot].z() / weight - 1.0;
  errors.energy = solved.report.energy.elastic / energy - 1.0;
  errors.account = left_over({}, solved.report.energy) / energy;
  return errors;
}

LoadField<Vector> gravity_along(const Vector& direction) {
  return [direction](const Vector&, double t) -> Vector { return t * g * direction; };
}

void expect_second_order(const std::string& name, const std::function<Column(Index)>& on) {
  std::vector<Column> columns;
  for (const Index n : {8, 16, 32}) {
    columns.push_back(on(n));
    const Column& c = columns.back();
    report_row(fmt::format("{}, {} cells", name, n), {{"u", c.displacement},
                                                      {"stress", c.stress},
                                                      {"reaction", c.reaction},
                                                      {"energy", c.energy},
                                                      {"account", c.account}});
    EXPECT_LT(std::abs(c.reaction), 1e-9);
    EXPECT_LT(std::abs(c.account), 1e-9);
  }
  EXPECT_LT(columns[2].displacement, 1e-3);
  EXPECT_LT(columns[2].displacement, columns[1].displacement / 3.5);
  EXPECT_LT(columns[2].stress, 1e-11);
  EXPECT_LT(std::abs(columns[2].energy), std::max(std::abs(columns[1].energy) / 3.0, 1e-11));  // or exact
}

TEST(BodyLoads, ColumnUnderItsOwnWeight) {
  for (const double grading : {1.0, 4.0})
    expect_second_order(fmt::format("graded {:g}", grading), [&](Index n) {
      const Mesh mesh = make_box_hexes(column_box(n, grading));
      FractureModel model = elastic_model({from_young_poisson(E, 0.0)}, stands());
      model.regions[0].density = rho;
      model.loads.gravity = gravity_along(-Vector::UnitZ());
      const double q = rho * g;
      return weigh(
          mesh, model, [&](double z) { return -q * (L * z - 0.5 * z * z) / E; }, [&](double z) { return -q * (L - z); },
          q * L, q * q * L * L * L / (6.0 * E));
    });
}

// The lower half of half the stiffness and twice the density.
TEST(BodyLoads, ColumnOfTwoMaterials) {
  const double q = rho * g, half = 0.5 * L;
  const auto stress = [&](double z) { return z < half ? -q * half - 2.0 * q * (half - z) : -q * (L - z); };
  const auto exact = [&](double z) {
    const auto lower = [&](double y) { return -(q * half * y + 2.0 * q * (half * y - 0.5 * y * y)) / (0.5 * E); };
    const auto upper = [&](double y) { return -q * (half * y - 0.5 * y * y) / E; };
    return z < half ? lower(z) : lower(half) + upper(z - half);
  };
  const double energy = 0.5 / (0.5 * E) * q * q * half * half * half * (1.0 + 2.0 + 4.0 / 3.0) +
                        0.5 / E * q * q * half * half * half / 3.0;
  expect_second_order("two materials", [&](Index n) {
    BoxHexesSettings box = column_box(n, 1.0);
    box.base_region = "upper";
    box.regions = {{.name = "lower", .lower = {-1.0, -1.0, -1.0}, .upper = {2.0, 2.0, half}}};
    const Mesh mesh = make_box_hexes(box);
    FractureModel model = elastic_model(std::vector<IsotropicElasticity>(2), stands());
    for (std::size_t r = 0; r < 2; ++r) {
      const bool is_lower = mesh.region_names[r] == "lower";
      model.regions[r].elasticity = from_young_poisson(is_lower ? 0.5 * E : E, 0.0);
      model.regions[r].density = is_lower ? 2.0 * rho : rho;
    }
    model.loads.gravity = gravity_along(-Vector::UnitZ());
    return weigh(mesh, model, exact, stress, 1.5 * q * L, energy);
  });
}

TEST(BodyLoads, CantileverUnderItsOwnWeight) {
  constexpr double span = 10.0, height = 1.0, nu = 0.3;
  for (const bool plane_stress : {false, true})
    for (const auto& [along, across] : {std::pair<Index, Index>{40, 4}, {10, 4}, {80, 8}}) {
      BoxHexesSettings box;
      box.axes = {{{{span, along, 1.0}}, {{height, across, 1.0}}, {{0.5, 1, 1.0}}}};
      const Mesh mesh = make_box_hexes(box);
      const auto side = plane_stress ? plane_stress_on : plane_on;
      FractureModel model =
          elastic_model({from_young_poisson(E, nu)},
                        {side("zmin"), side("zmax"),
                         displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); })});
      model.regions[0].density = rho;
      model.loads.gravity = gravity_along(-Vector::UnitY());
      const Solved solved = solve(mesh, model);
      const auto end = mesh.patch_index("xmax");
      const double q = rho * g * height, modulus = plane_stress ? E : E / (1.0 - nu * nu);
      const double w = q * std::pow(span, 4) / (8.0 * modulus * height * height * height / 12.0) +
                       q * span * span / (2.0 * 5.0 / 6.0 * E / (2.0 + 2.0 * nu) * height);
      const double found = -solved.report.patch_displacement[end].y() / w;
      report_row(
          fmt::format("{} x {} cells{}", along, across, plane_stress ? ", plane stress" : ""),
          {{"deflection", found}, {"account", left_over({}, solved.report.energy) / solved.report.energy.elastic}});
      EXPECT_NEAR(found, 1.0, 0.02);
      EXPECT_LT(std::abs(left_over({}, solved.report.energy)), 1e-8 * solved.report.energy.elastic);
    }
}

// A ring's sector of one cell, by the box bent about the axis z.
Mesh ring_sector(Index n, double inner, double outer, double angle) {
  BoxHexesSettings box;
  box.origin = Vector(inner, -0.5, 0.0);
  box.axes = {{{{outer - inner, n, 1.0}}, {{1.0, 1, 1.0}}, {{0.2, 2, 1.0}}}};
  box.sides = {"inner", "outer", "front", "back", "zmin", "zmax"};
  Mesh mesh = make_box_hexes(box);
  for (Vector& x : mesh.points) {
    const double a = angle * x[1], r = x[0];
    x = Vector(r * std::cos(a), r * std::sin(a), x[2]);
  }
  compute_geometry(mesh);
  return mesh;
}

TEST(BodyLoads, RotatingRing) {
  constexpr double a = 1.0, b = 2.0, w = 300.0;
  const double k = rho * w * w / E;
  std::vector<double> errors;
  for (const Index n : {8, 16, 32}) {
    const Mesh mesh = ring_sector(n, a, b, 0.5 / static_cast<double>(n));
    FractureModel model = elastic_model({from_young_poisson(E, 0.0)},
                                        {axisymmetric_on("front"), axisymmetric_on("back"), symmetry_on("zmin")});
    model.loads.force = [](const Vector& x, double t) {
      return Vector(t * rho * w * w * x[0], t * rho * w * w * x[1], 0.0);
    };
    const Solved solved = solve(mesh, model);
    const auto exact = [&](double r) {
      return 3.0 * k / 8.0 * ((a * a + b * b) * r + a * a * b * b / r) - k * r * r * r / 8.0;
    };
    errors.push_back(relative_error(
        mesh, [&](Index c) { return solved.fields.displacement[c]; },
        [&](Index c) { return Vector(exact(mesh.cell_centre[c].x()), 0.0, 0.0); }, [](Index) { return true; }));
    report_row(fmt::format("{} cells", n),
               {{"u", errors.back()}, {"account", left_over({}, solved.report.energy) / solved.report.energy.elastic}});
    EXPECT_LT(std::abs(left_over({}, solved.report.energy)), 1e-8 * solved.report.energy.elastic);
  }
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_LT(errors[2], errors[1] / 3.0);
}

// Whose foot is shortened by a sixth.
TEST(BodyLoads, ColumnAtFiniteStrain) {
  const IsotropicElasticity soft = from_young_poisson(1e6, 0.0);
  constexpr double q = 1.2e4;
  const auto stretch = [&](double z) {  // F (F^2 - 1)/2 = -q (L - z)/E
    double F = 1.0;
    for (int i = 0; i < 60; ++i) F -= (0.5 * F * (F * F - 1.0) + q * (L - z) / 1e6) / (1.5 * F * F - 0.5);
    return F;
  };
  const auto exact = [&](double z) {  // Simpson
    constexpr int m = 200;
    double sum = 0.0;
    for (int i = 0; i <= m; ++i)
      sum += (i == 0 || i == m ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * (stretch(z * i / m) - 1.0);
    return sum * z / m / 3.0;
  };
  std::vector<double> errors;
  for (const Index n : {10, 20}) {
    const Mesh mesh = make_box_hexes(column_box(n, 1.0));
    FractureModel model = elastic_model({soft}, stands());
    model.regions[0].material = make_hyperelastic("saint_venant_kirchhoff", {.elasticity = soft});
    model.loads.force = [](const Vector&, double t) { return Vector(0.0, 0.0, -t * q); };
    const Solved solved = solve(mesh, model, 20);
    errors.push_back(relative_error(
        mesh, [&](Index c) { return solved.fields.displacement[c]; },
        [&](Index c) { return Vector(0.0, 0.0, exact(mesh.cell_centre[c].z())); }, [](Index) { return true; }));
    const double account = left_over({}, solved.report.energy) / solved.report.energy.elastic;
    report_row(fmt::format("{} cells", n), {{"u", errors.back()}, {"account", account}, {"top", exact(L) / L}});
    EXPECT_LT(std::abs(account), 2e-3);  // of the trapezoidal rule in 20 steps
  }
  EXPECT_LT(errors[1], 2e-3);
  EXPECT_LT(errors[1], errors[0] / 3.0);
}

// A bar that hangs, with its weight from the first step on: the account stays closed while it breaks (but for the jump
// at its end), the weight of what is broken acts on, and a run that goes on from its middle ends in the same state.
TEST(BodyLoads, HangingBarBreaksWithItsWeight) {
  const Bar bar({.length = 4.3, .residual_stiffness = 1e-4});
  FractureModel model = bar.model();
  const double weight = 0.02 * bar.strength() * bar.area(), volume = bar.length() * bar.area();
  model.loads.force = [=](const Vector&, double) { return Vector(weight / volume, 0.0, 0.0); };
  const StaggeredSettings tight{.damage_tolerance = 1e-6, .energy_tolerance = 1e-6, .equilibrium_tolerance = 1e-9};
  const LoadingSettings loading{.end = 3.0, .initial_increment = 0.05, .maximum_increment = 0.05, .stops = {}};
  FractureRun run(bar.mesh(), model, tight, loading);
  const auto upper = bar.mesh().patch_index("xmin");
  const auto lower = bar.mesh().patch_index("xmax");
  StepReport last;
  FractureState middle;
  double balance = 0.0, account = 0.0;
  const FractureState end = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.step == 20) middle = state;
    if (report.step > 0) {
      balance = std::max(balance, std::abs(report.reaction[upper][0] + report.reaction[lower][0] + weight) / weight);
      account = std::max(account, std::abs(left_over({}, report.energy)) / (Bar::Gc * bar.area()));
    }
    last = report;
  });
  report_row("bar", {{"forces", balance},
                     {"account over Gc", account},
                     {"damage", last.max_damage},
                     {"upper force over weight", -last.reaction[upper][0] / weight}});
  EXPECT_GT(last.max_damage, 0.99);
  EXPECT_LT(balance, 1e-6);
  EXPECT_LT(account, 0.05);  // 0.032, of the jump in which it breaks
  FractureRun again(bar.mesh(), model, tight, loading);
  const FractureState resumed = advance_to_end(again, middle, [](const FractureState&, const StepReport&) {});
  EXPECT_EQ(resumed.displacement, end.displacement);
  EXPECT_EQ(resumed.energy, end.energy);
}

}  // namespace
}  // namespace pfdm::verification::this_file
