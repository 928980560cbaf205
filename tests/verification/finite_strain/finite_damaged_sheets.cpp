// Damaged sheets in plane stress at finite strain: their one energy and Cauchy stress, the derivative of the balance
// where cells are broken, a sheet with a crack.

#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/finite_sheets.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/finite.h"
#include "tests/verification/finite_sheets.h"
#include "tests/verification/noise.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::sheets;

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
        const FiniteSheets cells(mesh, model);
        const Tensor H = Tensor(l.asDiagonal()) + shear - Tensor::Identity();
        const auto stored = [&](const Tensor& at, double g) {
          return cells.stored_energy(0, cells.energies(0, stretched_cell(at), {g}), g) / volume;
        };
        for (const double g : {0.5, 2e-2, 2.9e-3, 1e-3, 3.5e-4, 1e-4, 1e-6}) {
          const double e = 1e-4 * g, slope = (stored(H, g + e) - stored(H, g - e)) / (2.0 * e);
          const double driving = cells.driving_energy(0, cells.energies(0, stretched_cell(H), {g}), g).value;
          of_g = std::max(of_g, std::abs(driving - std::max(slope, 0.0)) / std::abs(slope));
          const Tensor direction = Vector(1.0, 0.7, 0.0).asDiagonal().toDenseMatrix() + shear,
                       P = cells.law({0}, H, {g}).stress;
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
      const FiniteSheets cells(mesh, model);
      double most = 0.0;
      for (const double d : {0.9, 0.95, 0.97, 0.985, 0.99, 0.995, 1.0})
        for (const Tensor& F : {Tensor(Tensor::Identity()), Tensor(Vector(1.1, 1.0, 1.0).asDiagonal()),
                                Tensor(Vector(1.5, 0.9, 1.0).asDiagonal()), turned}) {
          const double g = (1.0 - 1e-6) * (1.0 - d) * (1.0 - d) + 1e-6;
          const Tensor H = F - Tensor::Identity();
          if (F.determinant() < 0.0 && d < 0.995) continue;
          CellMechanics mechanics = stretched_cell(H);
          mechanics.stress = CellField<Tensor>(1, cells.law({0}, H, {g}).stress);
          const Tensor stress = cells.cauchy_stress(0, mechanics, {g}, Vector::UnitZ());
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
  const auto stiffness = make_cell_stiffness(mesh, model);
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
  const auto linearise = [&] { stiffness->set(state, momentum); };
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
