// A plate of endochronic cells with a hole under cyclic load: its convergence, and the account of its work.

#include "mesh/geometry.h"
#include "solver/fracture/fracture_run.h"
#include "solver/point/mixed_control.h"
#include "tests/verification/histories/endochronic_bodies.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

// A quarter of a square plate with a round hole of a third of its width, the mesh of a box bent around it.
Mesh plate_with_hole(Index n) {
  constexpr double a = 1.0, b = 3.0, quarter = std::numbers::pi / 2.0;
  Mesh mesh = make_box_hexes({.axes = {{{{1.0, n, 4.0}}, {{quarter, 2 * n, 1.0}}, {{0.2, 1, 1.0}}}},
                              .regions = {},
                              .slits = {},
                              .patches = {{"top", Vector(1.0, 0.5 * quarter, 0.0), Vector(1.0, quarter, 1.0)}}});
  for (Vector& x : mesh.points) {
    const double s = x[0], angle = x[1];
    const double across = std::max(std::cos(angle), std::sin(angle));
    const double radius = (1.0 - s) * a + s * b / across;
    x = Vector(radius * std::cos(angle), radius * std::sin(angle), x[2]);
  }
  compute_geometry(mesh);
  return mesh;
}

struct Loop {
  double peak = 0.0, reverse = 0.0, heat = 0.0, imbalance = 0.0;
  Index most_iterations = 0;
};

// Stretched, pressed and stretched again by 0.3 %: the force on the top at the turns and the heat of it all.
Loop cycle_plate(Index n, Index n_steps) {
  const Mesh mesh = plate_with_hole(n);
  const FractureModel model =
      endochronic_model(soft_metal(), {symmetry_on("ymin"), symmetry_on("ymax"), plane_on("zmin"), plane_on("zmax"),
                                       moved("top", {false, true, false}, [](const Vector&, double t) {
                                         return Vector(0.0, 0.009 * std::sin(2.5 * std::numbers::pi * t), 0.0);
                                       })});
  const auto steps = steps_of(mesh, model, in_steps(n_steps),
                              {.damage_tolerance = 1e-4, .energy_tolerance = 1e-7, .equilibrium_tolerance = 1e-7});
  const auto top = mesh.patch_index("top");
  Loop loop;
  for (const Step& step : steps) {
    loop.peak = std::max(loop.peak, step.report.reaction[top][1]);
    loop.reverse = std::min(loop.reverse, step.report.reaction[top][1]);
  }
  const StepReport& last = steps.back().report;
  loop.heat = last.energy.plastic_dissipation;
  loop.imbalance =
      (last.energy.external_work - last.energy.elastic - last.energy.plastic_dissipation) / last.energy.external_work;
  loop.most_iterations = most_iterations(steps);
  return loop;
}

void report(Index n, const Loop& l) {
  report_row(std::to_string(n), {{"peak", l.peak},
                                 {"reverse", l.reverse},
                                 {"heat", l.heat},
                                 {"imbalance", l.imbalance},
                                 {"iterations", double(l.most_iterations)}});
}

TEST(EndochronicCells, APlateWithAHoleConvergesUnderCyclicLoad) {
  std::vector<Loop> loops;
  for (const Index n : {6, 12, 24, 48}) {
    loops.push_back(cycle_plate(n, 40));
    report(n, loops.back());
    EXPECT_LE(loops.back().most_iterations, 9);
  }
  const auto expect_near = [&](double Loop::*value, double bound_of_coarsest) {
    const double finest = loops[3].*value;
    EXPECT_NEAR(loops[0].*value, finest, bound_of_coarsest * std::abs(finest));
    EXPECT_NEAR(loops[1].*value, finest, 4e-3 * std::abs(finest));
    EXPECT_NEAR(loops[2].*value, finest, 1e-3 * std::abs(finest));
  };
  expect_near(&Loop::peak, 3e-3);
  expect_near(&Loop::reverse, 3e-3);
  expect_near(&Loop::heat, 0.02);
}

// What is left over has a part of second order in the increment, and one of the mesh.
TEST(EndochronicCells, WorkIsStoredOrHeat) {
  std::vector<double> imbalance;
  for (const Index n_steps : {20, 40, 80, 160}) {
    const Loop loop = cycle_plate(8, n_steps);
    report(n_steps, loop);
    imbalance.push_back(loop.imbalance);
  }
  const auto order = [&](std::size_t i) {
    return std::log2((imbalance[i - 1] - imbalance[i]) / (imbalance[i] - imbalance[i + 1]));
  };
  report_row("order", {{"40 steps", order(1)}, {"80 steps", order(2)}});
  EXPECT_NEAR(order(1), 2.0, 0.15);
  EXPECT_NEAR(order(2), 2.0, 0.15);
  EXPECT_LT(std::abs(imbalance.back()), 4e-3);
}

}  // namespace
}  // namespace pfdm::verification::this_file
