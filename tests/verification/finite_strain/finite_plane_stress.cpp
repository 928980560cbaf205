// Plane stress at finite strain: sheets of every law beside a block that is free across, the limit of small strain, the
// derivative of the balance where cells are broken, the one energy of a damaged sheet and its Cauchy stress.

#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/finite.h"
#include "tests/verification/noise.h"

#include "physics/error.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/finite_cells.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.49);

std::shared_ptr<const Material> law_of(std::string_view name, const IsotropicElasticity& elasticity = rubber) {
  HyperelasticParameters parameters{.elasticity = elasticity};
  if (name == "mooney_rivlin") parameters.second_invariant = 0.2;
  if (name == "ogden") parameters.shares = {0.7, 0.3}, parameters.exponents = {1.3, 4.0};
  if (name == "lopez_pamies") parameters.shares = {0.8, 0.2}, parameters.exponents = {0.6, 2.0};
  return make_hyperelastic(name, parameters);
}

Mesh sheet(Index n) {
  return make_box_hexes({.axes = {{{{.length = 1.0, .n = n}}, {{.length = 1.0, .n = n}}, {{.length = 0.1, .n = 1}}}},
                         .regions = {},
                         .slits = {}});
}

// Held by a gradient within the plane.
std::vector<BoundaryCondition> stretched(const Tensor& H, bool is_sheet) {
  std::vector<BoundaryCondition> boundary;
  for (const char* patch : {"xmin", "xmax", "ymin", "ymax"})
    boundary.push_back(
        moved(patch, {true, true, false}, [H](const Vector& x, double t) -> Vector { return t * H * x; }));
  if (is_sheet)
    boundary.push_back(plane_stress_on("zmin")), boundary.push_back(plane_stress_on("zmax"));
  else
    boundary.push_back(symmetry_on("zmin"));
  return boundary;
}

// A stretch of 1.8, a shear, a contraction.
TEST(FinitePlaneStress, ASheetOfEachLawIsABlockThatIsFreeAcross) {
  const Tensor H = (Tensor() << 0.8, 0.3, 0.0, -0.1, -0.2, 0.0, 0.0, 0.0, 0.0).finished();
  const Mesh mesh = sheet(3);
  for (const char* name : {"neo_hookean", "mooney_rivlin", "ogden", "lopez_pamies"}) {
    const auto material = law_of(name);
    const Drawn thin = draw(mesh, finite_body(mesh, material, stretched(H, true)), 2, 1e-11);
    const Drawn block = draw(mesh, finite_body(mesh, material, stretched(H, false)), 2, 1e-11);
    const double force =
        (thin.force(mesh, "xmax") - block.force(mesh, "xmax")).norm() / block.force(mesh, "xmax").norm();
    const double energy = thin.report.energy.elastic / block.report.energy.elastic - 1.0;
    report_row(fmt::format("sheet of {}", name), {{"force", force}, {"energy", energy}});
    EXPECT_LE(force, 1e-8);
    EXPECT_NEAR(energy, 0.0, 1e-8);
  }
}

// By hand: neo-Hookean in uniaxial tension to a stretch of 2; P_xx and the contraction across.
TEST(FinitePlaneStress, UniaxialTensionIsTheClosedForm) {
  const Mesh mesh = sheet(2);
  std::vector<BoundaryCondition> boundary{
      moved("xmax", {true, false, false}, [](const Vector&, double t) -> Vector { return t * Vector::UnitX(); }),
      symmetry_on("xmin"), symmetry_on("ymin"), plane_stress_on("zmin"), plane_stress_on("zmax")};
  FractureRun run(mesh, finite_body(mesh, law_of("neo_hookean"), boundary), {.equilibrium_tolerance = 1e-11},
                  {.initial_increment = 0.5, .maximum_increment = 0.5, .stops = {}});
  StepReport last;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
  double low = 0.5, high = 1.0;  // stretch across
  const auto stress_across = [](double s) {
    return rubber.mu * (s - 1.0 / s) + rubber.lambda * (2.0 * s * s - 1.0) * 2.0 * s;
  };
  for (int i = 0; i < 100; ++i) (stress_across(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  const double J = 2.0 * low * low, P = rubber.mu * (2.0 - 0.5) + rubber.lambda * (J - 1.0) * J / 2.0;
  const double force = last.reaction[mesh.patch_index("xmax")].x() / 0.1;
  const OutputFields fields = run.output(end);
  report_row("uniaxial", {{"force", force / P - 1.0},
                          {"stretch across", fields.deformation_gradient[0](2, 2) / low - 1.0},
                          {"stress across / P", fields.stress[0](2, 2) / P}});
  EXPECT_NEAR(force / P, 1.0, 1e-9);
  EXPECT_NEAR(fields.deformation_gradient[0](2, 2) / low, 1.0, 1e-9);
  EXPECT_NEAR(fields.stress[0](2, 2) / P, 0.0, 1e-9);
}

std::vector<BoundaryCondition> bent(double size) {
  std::vector<BoundaryCondition> boundary{
      moved("xmin", {true, true, true}, [](const Vector&, double) -> Vector { return Vector::Zero(); }),
      moved("xmax", {true, true, true},
            [size](const Vector&, double t) -> Vector { return size * t * Vector(0.6, 0.8, 0.0); })};
  boundary.push_back(plane_stress_on("zmin")), boundary.push_back(plane_stress_on("zmax"));
  return boundary;
}

TEST(FinitePlaneStress, IsThatOfSmallStrainWhereItIsSmall) {
  const Mesh mesh = sheet(8);
  const FractureModel finite = finite_body(mesh, law_of("neo_hookean"), bent(1e-7));
  const FractureModel small = elastic_model({rubber}, bent(1e-7));
  const Drawn a = draw(mesh, finite, 1, 1e-10), b = draw(mesh, small, 1, 1e-10);
  double u_error = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    u_error = std::max(u_error, (a.state.displacement[c] - b.state.displacement[c]).norm() / 1e-7);
  const double force = (a.force(mesh, "xmax") - b.force(mesh, "xmax")).norm() / b.force(mesh, "xmax").norm();
  report_row("small strain", {{"displacement", u_error}, {"force", force}});
  EXPECT_LE(u_error, 1e-6);
  EXPECT_LE(force, 1e-6);
}

TEST(FinitePlaneStress, WhatItIsNotCombinedWithIsRefused) {
  const Mesh mesh = sheet(2);
  const auto refusal = [&](const FractureModel& model) -> std::string {
    try {
      const FractureRun run(mesh, model, {}, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  FractureModel model = finite_body(mesh, law_of("neo_hookean"), bent(0.1));
  EXPECT_EQ(refusal(model), "");
  model.regions[0].damageable = true, model.regions[0].Gc = 1.0, model.regions[0].ell = 1.0;
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("volumetric_deviatoric");
  EXPECT_THAT(refusal(model), testing::HasSubstr("only be combined with the energy split \"none\""));
  const auto stiff = make_hyperelastic("saint_venant_kirchhoff", {.elasticity = from_young_poisson(1e6, 0.3)});
  EXPECT_THAT(refusal(finite_body(mesh, stiff, bent(0.1))), testing::HasSubstr("saint_venant_kirchhoff"));
  std::vector<BoundaryCondition> inflated = bent(0.1);
  inflated.back().pressure = [](const Vector&, double t) { return t; };
  EXPECT_THAT(refusal(finite_body(mesh, law_of("neo_hookean"), inflated)),
              testing::HasSubstr("cannot be combined with the pressure on patch"));
  FractureModel glued_sheet = finite_body(mesh, law_of("neo_hookean"), bent(0.1));
  const auto& linear = find_by_name(traction_separation_laws(), "linear", "law");
  glue(glued_sheet, mesh, verification::law_of(linear), glued, Vector::UnitX(),
       [](const Vector& x) { return std::abs(x.x() - 0.5) < 1e-9; });
  EXPECT_THAT(refusal(glued_sheet), testing::HasSubstr("plane stress cannot be combined with cohesive interfaces"));
}

FractureModel damaged_sheet(const Mesh& mesh, std::string_view law, double nu,
                            std::vector<BoundaryCondition> boundary) {
  FractureModel model = finite_body(mesh, law_of(law, from_young_poisson(1.5e6, nu)), std::move(boundary));
  for (RegionModel& region : model.regions) region.damageable = true, region.Gc = 1.0, region.ell = 1.0;
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  return model;
}

CellMechanics stretched_cell(const Tensor& H) {
  CellMechanics mechanics;
  mechanics.gradient = CellField<Tensor>(1, H);
  mechanics.energy = CellField<double>(1, 0.0);
  return mechanics;
}

// Of a thinned cell: its driving energy and its stress in the plane against differences of what it stores.
TEST(FinitePlaneStress, OneEnergyDrivesTheDamageAndHasTheStress) {
  const Mesh mesh = sheet(1);
  const double volume = mesh.cell_volume[0];
  Tensor shear = Tensor::Zero();
  shear(0, 1) = 0.3, shear(1, 0) = -0.1;
  double of_g = 0.0, of_stress = 0.0;
  for (const char* law : {"neo_hookean", "ogden"})
    for (const double nu : {0.45, 0.497})
      for (const Vector& l : {Vector(1.2, 0.9, 1.0), Vector(4.0, 0.6, 1.0), Vector(2.0, 2.0, 1.0)}) {
        const FractureModel model = damaged_sheet(mesh, law, nu, bent(0.0));
        const FiniteCells cells(mesh, model);
        const Tensor H = Tensor(l.asDiagonal()) + shear - Tensor::Identity();
        const auto stored = [&](const Tensor& at, double g) {
          return cells.stored_energy(0, cells.energies(0, stretched_cell(at), g), g) / volume;
        };
        for (const double g : {0.5, 2e-2, 2.9e-3, 1e-3, 3.5e-4, 1e-4, 1e-6}) {
          const double e = 1e-4 * g, slope = (stored(H, g + e) - stored(H, g - e)) / (2.0 * e);
          const double driving = cells.driving_energy(0, cells.energies(0, stretched_cell(H), g), g).value;
          of_g = std::max(of_g, std::abs(driving - std::max(slope, 0.0)) / std::abs(slope));
          const Tensor direction = Vector(1.0, 0.7, 0.0).asDiagonal().toDenseMatrix() + shear,
                       P = cells.law(0, H, g, 0.0).stress;
          const double step = 1e-5, change = stored(H + step * direction, g) - stored(H - step * direction, g);
          of_stress = std::max(
              of_stress, std::abs(change / (2.0 * step) - contract(P, direction)) / (P.norm() * direction.norm()));
        }
      }
  report_row("one energy of a sheet", {{"driving energy", of_g}, {"stress", of_stress}});
  EXPECT_LE(of_g, 1e-6);
  EXPECT_LE(of_stress, 1e-6);
}

// A network that is stretched within its plane has no thickness at which it is free: its Cauchy stress is that at the
// thickness of the sound sheet, of the order of g mu.
TEST(FinitePlaneStress, TheCauchyStressOfABrokenSheetIsSmall) {
  const Mesh mesh = sheet(1);
  const Tensor turned = (Tensor() << -0.2, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0).finished();
  for (const char* law : {"neo_hookean", "ogden"})
    for (const double nu : {0.45, 0.48, 0.49, 0.497}) {
      const FractureModel model = damaged_sheet(mesh, law, nu, bent(0.0));
      const FiniteCells cells(mesh, model);
      double most = 0.0;
      for (const double d : {0.9, 0.95, 0.97, 0.985, 0.99, 0.995, 1.0})
        for (const Tensor& F : {Tensor(Tensor::Identity()), Tensor(Vector(1.1, 1.0, 1.0).asDiagonal()),
                                Tensor(Vector(1.5, 0.9, 1.0).asDiagonal()), turned}) {
          const double g = (1.0 - 1e-6) * (1.0 - d) * (1.0 - d) + 1e-6;
          const Tensor H = F - Tensor::Identity();
          if (F.determinant() < 0.0 && d < 0.995) continue;
          CellMechanics mechanics = stretched_cell(H);
          mechanics.stress = CellField<Tensor>(1, cells.law(0, H, g, 0.0).stress);
          const Tensor stress = cells.cauchy_stress(0, mechanics, g, Vector::UnitZ());
          ASSERT_TRUE(stress.allFinite()) << law << " " << nu << " " << d << "\n" << F;
          most = std::max(most, stress.norm() / (g * model.regions[0].elasticity.mu));
        }
      report_row(fmt::format("broken sheet, {}, nu {}", law, nu), {{"largest Cauchy stress / (g mu)", most}});
      EXPECT_LE(most, 10.0);
    }
}

// The crack across the sheet is there from the beginning.
TEST(FinitePlaneStress, ACrackedSheetIsPulledApart) {
  const Mesh mesh = sheet(5);
  for (const char* law : {"neo_hookean", "ogden"})
    for (const double nu : {0.45, 0.49}) {
      FractureModel model = damaged_sheet(mesh, law, nu, bent(0.2));
      model.regions[0].ell = 0.1;
      model.initial_damage = CellField<double>(mesh.n_cells(), 0.0);
      for (Index c = 0; c < mesh.n_cells(); ++c)
        if (std::abs(mesh.cell_centre[c].x() - 0.5) < 0.05) model.initial_damage[c] = 1.0;
      FractureRun run(mesh, model, {}, {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
      const FractureState end = run_to_end(run, [](const FractureState&, const StepReport&) {});
      double most = 0.0;
      const OutputFields fields = run.output(end);
      for (Index c = 0; c < mesh.n_cells(); ++c)
        most = fields.stress[c].allFinite() ? std::max(most, fields.stress[c].norm()) : INFINITY;
      report_row(fmt::format("cracked sheet, {}, nu {}", law, nu), {{"largest stress / mu", most / rubber.mu}});
      EXPECT_LE(most, rubber.mu);
    }
}

double norm(const std::vector<Vector>& v) {
  double sum = 0.0;
  for (const Vector& x : v) sum += x.squaredNorm();
  return std::sqrt(sum);
}

// Forces at u + e v against those of the balance linearised about u: the difference is of second order in e. Damage
// differs from cell to cell, from sound to broken.
void expect_derivative(const Mesh& mesh, FractureModel model, std::string_view what) {
  for (RegionModel& region : model.regions) region.damageable = true, region.Gc = 1.0, region.ell = 1.0;
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("none");
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  const CellStiffness stiffness(mesh, model);
  MomentumSolver momentum(mesh, unknowns);
  FractureRun run(mesh, model, {}, {});
  FractureState state = run.initial_state();
  Noise noise;
  std::vector<Vector> from(state.displacement.size(), Vector::Zero()), direction = from;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const bool is_pressure = i >= as_size(unknowns.n_nodes());
    for (Index k = 0; k < (is_pressure ? 1 : 3); ++k) {
      from[i][k] = noise.next() * (is_pressure ? 1e3 : 0.02);
      direction[i][k] = noise.next() * (is_pressure ? 1e3 : 0.02);
    }
  }
  momentum.balance().keep_in_plane(from), momentum.balance().keep_in_plane(direction);
  for (Index c = 0; c < mesh.n_cells(); ++c) state.damage[c] = 1.0 - std::pow(10.0, -1.3 * (1.0 + noise.next()));
  const auto linearise = [&] { stiffness.set(state, momentum); };
  state.displacement = from;
  linearise();
  const std::vector<Vector> start = momentum.unbalanced_forces(0.0, state.displacement);
  std::vector<double> error;
  for (const double e : {1e-3, 1e-4}) {
    state.displacement = from;
    linearise();
    for (std::size_t i = 0; i < from.size(); ++i) state.displacement[i] += e * direction[i];
    const std::vector<Vector> linear = momentum.unbalanced_forces(0.0, state.displacement);
    linearise();
    std::vector<Vector> exact = momentum.unbalanced_forces(0.0, state.displacement), change = linear;
    for (std::size_t i = 0; i < from.size(); ++i) exact[i] -= linear[i], change[i] -= start[i];
    error.push_back(norm(exact) / norm(change));
  }
  report_row(fmt::format("damaged cells, {}", what), {{"error", error[0]}, {"of a tenth", error[1]}});
  EXPECT_LE(error[1], 0.15 * error[0]);
  EXPECT_LE(error[1], 1e-2);
}

TEST(FinitePlaneStress, TheLinearisedBalanceOfDamagedCellsIsTheDerivative) {
  const Mesh plate = sheet(5);
  expect_derivative(plate, finite_body(plate, law_of("neo_hookean"), bent(0.0)), "plane stress");
  expect_derivative(plate, finite_body(plate, law_of("ogden"), bent(0.0)), "plane stress, Ogden");
  for (const char* law : {"neo_hookean", "ogden"})
    expect_derivative(plate, finite_body(plate, law_of(law, from_young_poisson(1.5e6, 0.45)), bent(0.0)),
                      fmt::format("plane stress, nu 0.45, {}", law));
  const Mesh layered = sphere_in_cube(2, 2, 2.0, 0.8), polyhedra = barycentric_dual(layered);
  const auto held = [](const Mesh& mesh, std::string_view law) {
    return finite_body(
        mesh, law_of(law),
        {moved("zmin", {true, true, true}, [](const Vector&, double) -> Vector { return Vector::Zero(); })});
  };
  expect_derivative(layered, held(layered, "neo_hookean"), "tetrahedra and prisms");
  expect_derivative(polyhedra, held(polyhedra, "neo_hookean"), "polyhedra");
}

}  // namespace
}  // namespace pfdm::verification::this_file
