// A bead debonds from its block in one jump, whatever the load step in which it happens.

#include "physics/registry.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm::verification::this_file {
namespace {

// As the shipped beads, of radius 1: M Gc/ft^2 = 0.66 of the radius.
constexpr double strength = 26.9e6, toughness = 1.94e6;

InterfaceLaw brittle_law() {
  return {.law = &find_by_name(traction_separation_laws(), "linear", "law"),
          .shape = {},
          .mixed_mode = &find_by_name(mixed_modes(), "camacho_ortiz", "mixed mode")};
}

FractureModel bead_in_a_block(const Mesh& mesh) {
  FractureModel model = elastic_model({}, {});
  for (const std::string& name : mesh.region_names)
    model.regions.push_back(
        {.elasticity = name == "bead" ? from_young_poisson(70e9, 0.3) : from_young_poisson(75e6, 0.44),
         .damageable = false});
  model.boundary = {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                    moved("zmax", {false, false, true}, [](const Vector&, double t) { return Vector(0.0, 0.0, t); })};
  CohesiveSurface surface{.name = "bond", .law = brittle_law(), .faces = {}};
  const Index matrix =
      mesh.region_index("matrix");  // all else is cut off from it: the bead, and its coat if it has one
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const bool from = mesh.region[mesh.owner[f]] != matrix, to = mesh.region[mesh.neighbour[f]] != matrix;
    if (from == to) continue;
    surface.faces.push_back(f);
    surface.sign.push_back(from ? 1.0 : -1.0);
    surface.at.push_back({.strength = strength, .toughness = toughness});
  }
  model.interfaces.push_back(std::move(surface));
  return model;
}

struct Debonding {
  std::vector<double> force;  // at every step [N]
  double broken = 0.0;        // dissipated, over that of the whole surface
  double krylov_iterations = 0.0;
};

/// A power law of the rate of opening, and the time of the whole displacement; none without duration.
struct Resistance {
  double m = 1.0, reference_rate = 1.0, duration = 0.0;
};

Debonding debond(const Mesh& mesh, double displacement, double increment, const Resistance& resistance = {}) {
  FractureModel model = bead_in_a_block(mesh);
  if (resistance.duration > 0.0)
    model.interfaces[0].law.rate = {.law = &find_by_name(interface_rate_laws(), "power", "rate law"),
                                    .p = {resistance.m, resistance.reference_rate}};
  FractureRun run(mesh, std::move(model), {},
                  {.end = displacement,
                   .initial_increment = increment,
                   .minimum_increment = increment,
                   .maximum_increment = increment,
                   .duration = resistance.duration / displacement,
                   .stops = {}});
  const auto top = mesh.patch_index("zmax");
  Debonding result;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) {
    result.force.push_back(report.reaction[top].z());
    result.krylov_iterations += static_cast<double>(report.krylov_iterations);
  });
  result.broken = end.energy.interface_dissipation / (4.0 * std::acos(-1.0) * toughness);
  return result;
}

TEST(CohesiveJumps, OfABeadTakeTensOfSmallSolves) {
  const Mesh mesh = sphere_in_cube(4, 0, 3.0, 0.6);
  const Debonding few = debond(mesh, 1.8, 0.6), many = debond(mesh, 1.8, 0.2);
  report_row("bead that debonds in a jump", {{"cells", double(mesh.n_cells())},
                                             {"Krylov iterations of 3 steps", few.krylov_iterations},
                                             {"of 9 steps", many.krylov_iterations},
                                             {"force over that of 9 steps", few.force.back() / many.force.back()},
                                             {"broken part of the surface", few.broken}});
  EXPECT_NEAR(few.broken, 0.75, 0.05);
  EXPECT_LT(few.krylov_iterations, 3200.0);
  EXPECT_NEAR(few.force.back() / many.force.back(), 1.0, 0.02);
}

// Behind its interface a stiff bead in a soft coat turns and moves with little resistance: the two-point preconditioner
// finds that stiff (rigid_modes.h).
TEST(CohesiveJumps, OfACoatedBeadTakeFewIterationsThoughItTurnsFreely) {
  const Mesh mesh = sphere_in_cube(4, 1, 3.0, 0.6);
  const Debonding coated = debond(mesh, 2.4, 0.6);
  report_row("coated bead that debonds in a jump", {{"cells", double(mesh.n_cells())},
                                                    {"Krylov iterations of 4 steps", coated.krylov_iterations},
                                                    {"broken part of the surface", coated.broken / (1.4 * 1.4)}});
  EXPECT_GT(coated.broken / (1.4 * 1.4), 0.5);
  EXPECT_LT(coated.krylov_iterations, 4900.0);
}

// Past the debonding of both poles, at mean rates of 72 v_0 and 1/140 v_0. With a power law of the rate the faces that
// do not break any more come to rest, each at its own overstress, where the law is infinitely steep.
TEST(CohesiveJumps, OfABeadWithAPowerLawOfTheRateTakeAsFew) {
  const Mesh mesh = sphere_in_cube(3, 0, 3.0, 0.8);
  for (const double m : {0.05, 0.2})
    for (const double duration : {0.01, 100.0}) {
      const Debonding resisted = debond(mesh, 3.6, 0.3, {.m = m, .reference_rate = 5.0, .duration = duration});
      report_row(fmt::format("bead with a power law of the rate, m = {}, {} s", m, duration),
                 {{"cells", double(mesh.n_cells())},
                  {"Krylov iterations of 12 steps", resisted.krylov_iterations},
                  {"broken part of the surface", resisted.broken},
                  {"force at the end", resisted.force.back()}});
      EXPECT_GT(resisted.broken, 0.55);
      EXPECT_LT(resisted.krylov_iterations, 8000.0);
    }
}

}  // namespace
}  // namespace pfdm::verification::this_file
