// A glass bead in a rubber at finite strain: the linearised balance against differences of the true one, a bonded bead
// and one that debonds, both drawn to 80 % nominal strain.

#include "tests/verification/noise.h"
#include "tests/verification/support.h"

#include "physics/materials/hyperelastic.h"
#include "solver/fracture/equilibrium/finite_newton.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace pfdm::verification::this_file {
namespace {

constexpr double half_width = 2.5, elongation = 0.8 * 2.0 * half_width;

Mesh cube_in_cube(Index n) {
  const std::vector<AxisBlock> axis{{.length = 2.0 * half_width, .n = n}};
  return make_box_hexes({.origin = -half_width * Vector::Ones(),
                         .axes = {axis, axis, axis},
                         .regions = {{"bead", -Vector::Ones(), Vector::Ones()}},
                         .base_region = "matrix",
                         .slits = {}});
}

/// The top is pulled up and may contract, the bottom is glued.
FractureModel bead_in_rubber(const Mesh& mesh, double glass_modulus, double nu, double pull) {
  const IsotropicElasticity rubber = from_young_poisson(1.5e6, nu), glass = from_young_poisson(glass_modulus, 0.3);
  const auto around = make_hyperelastic("neo_hookean", {.elasticity = rubber});
  const auto in_bead = make_hyperelastic("saint_venant_kirchhoff", {.elasticity = glass});
  std::vector<IsotropicElasticity> elasticity;
  for (const std::string& name : mesh.region_names) elasticity.push_back(name == "bead" ? glass : rubber);
  FractureModel model = elastic_model(
      elasticity, {moved("zmin", {true, true, true}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
                   moved("zmax", {false, false, true},
                         [pull](const Vector&, double t) -> Vector { return pull * t * Vector::UnitZ(); })});
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    model.regions[r].material = mesh.region_names[r] == "bead" ? in_bead : around;
  return model;
}

double norm(const std::vector<Vector>& v) {
  double sum = 0.0;
  for (const Vector& x : v) sum += x.squaredNorm();
  return std::sqrt(sum);
}

std::vector<Vector> difference(std::vector<Vector> a, const std::vector<Vector>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

// What the forces of displacements u + e v differ by from those of the balance linearised about u, over what they
// change by: of first order in e if and only if that is the derivative.
TEST(FiniteBead, TheLinearisedBalanceIsTheDerivative) {
  const Mesh layered = sphere_in_cube(2, 3, half_width, 0.8);
  for (const Mesh& mesh : {layered, barycentric_dual(layered), cube_in_cube(5)})
    for (const double nu : {0.4, 0.4999}) {
      const FractureModel model = bead_in_rubber(mesh, 75e6, nu, 0.5 * elongation);
      FractureRun run(mesh, model, {}, {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
      FractureState state = run_to_end(run, [](const FractureState&, const StepReport&) {});
      const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
      const auto stiffness = make_cell_stiffness(mesh, model);
      MomentumSolver momentum(mesh, unknowns);
      stiffness->set(state, momentum);
      const std::vector<Vector> rest = momentum.unbalanced_forces(1.0, state.displacement), from = state.displacement;
      Noise noise;
      std::vector<Vector> direction(from.size(), Vector::Zero());
      for (std::size_t i = 0; i < from.size(); ++i) {
        const bool is_pressure = i >= as_size(unknowns.n_nodes());
        for (double& x : direction[i].head(is_pressure ? 1 : 3)) x = noise.next() * (is_pressure ? 1e6 : 0.1);
      }
      std::vector<double> error;
      for (const double e : {1e-2, 1e-3}) {
        state.displacement = from;
        stiffness->set(state, momentum);
        for (std::size_t i = 0; i < from.size(); ++i) state.displacement[i] += e * direction[i];
        const std::vector<Vector> linear = momentum.unbalanced_forces(1.0, state.displacement);
        stiffness->set(state, momentum);
        const std::vector<Vector> exact = momentum.unbalanced_forces(1.0, state.displacement);
        error.push_back(norm(difference(exact, linear)) / norm(difference(linear, rest)));
      }
      report_row(fmt::format("{} cells, nu {}", mesh.n_cells(), nu), {{"error", error[0]}, {"of a tenth", error[1]}});
      EXPECT_LE(error[1], 0.12 * error[0]);
      EXPECT_LE(error[1], 0.02);
    }
}

TEST(FiniteBead, BondedGlassIsDrawnTo80Percent) {
  const Mesh coarse = sphere_in_cube(2, 3, half_width, 0.8), fine = sphere_in_cube(4, 4, half_width, 0.5);
  for (const double nu : {0.3, 0.48, 0.4999}) {
    std::vector<double> forces;
    for (const Mesh& mesh : {coarse, fine, barycentric_dual(fine), cube_in_cube(10)}) {
      FractureRun run(mesh, bead_in_rubber(mesh, 70e9, nu, elongation), {.equilibrium_tolerance = 1e-8},
                      {.initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
      const std::clock_t start = std::clock();
      StepReport last;
      run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
      const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
      const auto top = mesh.patch_index("zmax");
      const double balance = last.energy.external_work / last.energy.elastic - 1.0;
      forces.push_back(last.reaction[top].z());
      report_row(fmt::format("nu {}, {} cells", nu, mesh.n_cells()),
                 {{"force / E R^2", forces.back() / 1.5e6},
                  {"work over energy - 1", balance},
                  {"steps", double(last.step)},
                  {"Krylov iterations", double(run.krylov_iterations())},
                  {"CPU s", seconds}});
      EXPECT_EQ(last.step, 10);  // no increment was cut
      EXPECT_LE(std::abs(balance), 0.015);
    }
    EXPECT_NEAR(forces[0], forces[1], 0.03 * forces[1]);
    EXPECT_NEAR(forces[2], forces[1], 0.01 * forces[1]);
  }
}

// AT2 without a split; both poles debond. Energies: work = elastic + surface, but for what the two jumps release.
TEST(FiniteBead, DebondsOnTheWayTo80Percent) {
  const Mesh mesh = barycentric_dual(sphere_in_cube(2, 3, half_width, 0.8));
  FractureModel model = bead_in_rubber(mesh, 70e9, 0.49, elongation);
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    const std::string& name = mesh.region_names[r];
    model.regions[r].damageable = name != "bead";
    model.regions[r].Gc = name == "interface" ? 4e5 : 8e6;
    model.regions[r].ell = 0.2;
  }
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  FractureRun run(mesh, model, {.damage_tolerance = 2e-3},
                  {.initial_increment = 0.1,
                   .maximum_increment = 0.1,
                   .energy_release = 0.02,
                   .finest_increment = 4e-3,
                   .stops = {}});
  double first_jump = 0.0, before = 0.0;
  StepReport last;
  run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.max_damage < 0.6) {
      first_jump = state.load;
      const double stored = report.energy.elastic + report.energy.fracture;
      if (stored > 0.0) before = report.energy.external_work / stored - 1.0;
    }
    last = report;
  });
  const double lost = 1.0 - (last.energy.elastic + last.energy.fracture) / last.energy.external_work;
  report_row(fmt::format("{} cells", mesh.n_cells()), {{"debonds beyond", first_jump},
                                                       {"work over energies before - 1", before},
                                                       {"damaged volume / R^3", last.damaged_volume},
                                                       {"largest damage", last.max_damage},
                                                       {"released in jumps, of the work", lost},
                                                       {"iterations", double(run.staggered_iterations())},
                                                       {"Krylov iterations", double(run.krylov_iterations())}});
  EXPECT_DOUBLE_EQ(last.load, 1.0);
  EXPECT_GT(last.max_damage, 0.9);
  EXPECT_GT(last.damaged_volume, 0.3);
  EXPECT_LE(std::abs(before), 0.04);
  EXPECT_GE(lost, -0.01);
}

}  // namespace
}  // namespace pfdm::verification::this_file
