// Beams of few or long cells: a cantilever of 25 x 1.5 mm, clamped at x = 0, under a force at its end, a moment there,
// or a load along it, against Timoshenko's beam (with a force w = P L^3/(3 E' I) + P L/(k mu h), k = 5/6; E' = E/(1 -
// nu^2) in plane strain); the plane field of a cantilever (Timoshenko, Goodier, Theory of Elasticity, art. 21), which
// is cubic. In space: bending_in_space.cpp; at finite strain: finite_bending.cpp.

#include "solver/momentum/bending/bending_layers.h"
#include "tests/verification/layers/cantilever.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::cantilever;

Index iterations_of_all = 0;

/// Mean deflection of the end over Timoshenko's; with these stiffness factors in the cells, if any.
double deflection(const Beam& beam, const CellField<double>& g = {}) {
  const Mesh mesh = mesh_of(beam.along, beam.across);
  FractureModel model = elastic_model({from_young_poisson(E, beam.nu)}, clamped_at_x0(beam.plane_stress));
  model.boundary.push_back(traction_of(beam.load));
  const auto solution = solve_elastic(mesh, model, g, 1e-9);
  EXPECT_TRUE(solution->equilibrium.converged);
  iterations_of_all += solution->equilibrium.iterations;
  EXPECT_LT(energy_imbalance(mesh, *solution), 1e-6);
  if (beam.load != Load::moment) {
    EXPECT_LT(reaction_imbalance(mesh, *solution), 1e-6);
  }
  const auto end = mesh.patch_index("xmax");
  return solution->solver->balance().patch_displacements(solution->u)[end].y() / timoshenko(beam);
}

// At nu = 0.45 the clamp, which Timoshenko's beam does not have, takes 1 to 1.5 %.
TEST(Bending, FourLayersOfCellsHalfToSixTimesAsLongAsThick) {
  for (const double nu : {0.0, 0.3, 0.45}) {
    double worst = 0.0;
    for (const double ratio : {0.5, 1.0, 2.0, 4.0, 6.0}) {
      Beam beam{.along = along_with(ratio, 4), .across = 4, .nu = nu};
      std::vector<std::pair<std::string, double>> row;
      for (const Load load : {Load::tip, Load::moment, Load::distributed}) {
        beam.load = load;
        row.emplace_back(load == Load::tip ? "force" : (load == Load::moment ? "moment" : "load"), deflection(beam));
        worst = std::max(worst, std::abs(row.back().second - 1.0));
      }
      report_row(fmt::format("nu = {}, {} x 4 cells, {} times as long as thick", nu, beam.along, ratio), row);
    }
    report_row("iterations so far", {{"n", static_cast<double>(iterations_of_all)}});
    EXPECT_LT(worst, nu > 0.4 ? 0.05 : 0.03) << nu;
  }
}

// One ring: 2.33, 1.341, 1.089, 0.967 times as stiff.
TEST(Bending, SixLayers) {
  for (const Index along : {12, 25, 42, 100})
    for (const bool plane_stress : {false, true}) {
      const double found = deflection({.along = along, .across = 6, .plane_stress = plane_stress});
      report_row(fmt::format("{} x 6 cells{}", along, plane_stress ? ", plane stress" : ""), {{"deflection", found}});
      EXPECT_NEAR(found, 1.0, 0.015);
    }
}

TEST(Bending, TwoToTwelveLayers) {
  for (const Index across : {2, 3, 5, 8, 12}) {
    const double square = deflection({.along = along_with(1.0, across), .across = across});
    const double flat = deflection({.along = along_with(4.0, across), .across = across});
    report_row(fmt::format("{} layers", across), {{"square cells", square}, {"four times as long as thick", flat}});
    EXPECT_NEAR(square, 1.0, 0.015) << across;
    EXPECT_NEAR(flat, 1.0, across > 2 ? 0.02 : 0.12) << across;  // with two layers 8 cells along the beam
  }
}

TEST(Bending, HalfABodyIsAsThickAsTheWhole) {
  const Mesh mesh = mesh_of(25, 4);
  for (const bool is_half : {false, true}) {
    std::vector<BoundaryCondition> conditions = clamped_at_x0(false);
    if (is_half) conditions.push_back(symmetry_on("ymin"));
    const FractureModel model = elastic_model({from_young_poisson(E, 0.3)}, conditions);
    const std::vector<BendingCell> cells = cells_of_layers(mesh, place_unknowns(mesh, elastic_body(model)));
    ASSERT_EQ(cells.size(), 100u);
    for (const BendingCell& in : cells) {
      EXPECT_NEAR(in.thickness, (is_half ? 2.0 : 1.0) * height, 1e-9);
      EXPECT_NEAR(in.zone_thickness, in.thickness, 1e-9);
    }
  }
}

// A body that has lost half of its stiffness everywhere bends twice as much.
TEST(Bending, OfEvenlyDamagedBeams) {
  const Beam beam{.along = 25, .across = 4};
  EXPECT_NEAR(deflection(beam, CellField<double>(100, 0.5)) / deflection(beam), 2.0, 1e-6);
}

// In plane stress: the displacements of the field at both ends, its sides free.
TEST(Bending, ConvergesToTheCubicFieldOfACantilever) {
  const double nu = 0.3, load = 1.0 / (6.0 * E * section), D = height;
  const auto exact = [=](const Vector& place) -> Vector {
    const double x = place.x(), y = place.y() - D / 2.0;
    return load * Vector(-y * ((6.0 * span - 3.0 * x) * x + (2.0 + nu) * (y * y - D * D / 4.0)),
                         3.0 * nu * y * y * (span - x) + (4.0 + 5.0 * nu) * D * D * x / 4.0 + (3.0 * span - x) * x * x,
                         0.0);
  };
  std::vector<double> errors;
  for (const Index across : {2, 4, 8}) {
    const Mesh mesh = mesh_of(5 * across, across);
    const FractureModel model =
        elastic_model({from_young_poisson(E, nu)}, {plane_stress_on("zmin"), plane_stress_on("zmax"),
                                                    displacement_on("xmin", exact), displacement_on("xmax", exact)});
    errors.push_back(displacement_error(mesh, *solve_elastic(mesh, model), exact));
    report_row(fmt::format("{} x {} cells", 5 * across, across), {{"displacement", errors.back()}});
  }
  EXPECT_LT(errors[0], 1e-2);
  EXPECT_LT(errors[1], errors[0] / 4.0);
  EXPECT_LT(errors[2], errors[1] / 4.0);
}

}  // namespace
}  // namespace pfdm::verification::this_file
