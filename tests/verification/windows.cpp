// Windows, in which the staggered loop goes on around the cells that change: a solution of the whole is one of a
// window, and a bead debonds with them as without, in fewer iterations of the whole.

#include "physics/error.h"
#include "solver/parallel.h"
#include "solver/window.h"
#include "tests/verification/bead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification {
namespace {

Mesh bead() { return sphere_in_cube(4, 8, 2.5, 0.4); }

struct Outcome {
  FractureState state;
  std::vector<double> force, fracture_energy;  // of every step [N], [J]
  Index iterations = 0;
  double window_iterations = 0.0;
};

Outcome debond(const Mesh& mesh, bool windows) {
  const std::string split = "volumetric_deviatoric";
  FractureRun run(mesh, bead_model(mesh, split, 0.2), {.maximum_iterations = 1000, .windows = windows},
                  {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
  Outcome outcome;
  RunHooks hooks;
  hooks.step_done = [&](const FractureState&, const StepReport& report) {
    const auto top = &mesh.patch("zmax") - mesh.patches.data();
    outcome.force.push_back(report.reaction[static_cast<std::size_t>(top)].z());
    outcome.fracture_energy.push_back(report.fracture_energy);
  };
  outcome.state = run.run(run.initial_state(), hooks);
  outcome.iterations = run.staggered_iterations();
  outcome.window_iterations = run.window_iterations();
  return outcome;
}

TEST(Windows, LetABeadDebondAsWithoutThem) {
  const Mesh mesh = bead();
  const Outcome plain = debond(mesh, false), with = debond(mesh, true);
  EXPECT_GT(*std::ranges::max_element(plain.state.damage.values()), 0.99);
  ASSERT_EQ(with.force.size(), plain.force.size());
  double force = 0.0, energy = 0.0;
  for (std::size_t i = 1; i < plain.force.size(); ++i) {
    force = std::max(force, std::abs(with.force[i] / plain.force[i] - 1.0));
    energy = std::max(energy, std::abs(with.fracture_energy[i] / plain.fracture_energy[i] - 1.0));
  }
  report_row(std::to_string(mesh.n_cells()) + " cells", {{"iterations without", plain.iterations},
                                                         {"with", with.iterations},
                                                         {"in windows", with.window_iterations},
                                                         {"force differs by", force},
                                                         {"fracture energy", energy}});
  EXPECT_EQ(plain.window_iterations, 0.0);
  EXPECT_GT(with.window_iterations, 0.0);
  EXPECT_LT(4 * with.iterations, 3 * plain.iterations);
  EXPECT_LE(force, 5e-3);
  EXPECT_LE(energy, 2e-2);
}

TEST(Windows, ComeToTheSameWithAnyNumberOfThreads) {
  const Mesh mesh = bead();
  set_threads(1);
  const Outcome alone = debond(mesh, true);
  set_threads(3);
  const Outcome together = debond(mesh, true);
  set_threads(1);
  EXPECT_TRUE(together.state.displacement == alone.state.displacement);
  EXPECT_TRUE(together.state.damage == alone.state.damage);
}

// With broken cells at the cut.
TEST(Windows, LeaveASolutionOfTheWholeAsItIs) {
  const Mesh mesh = bead();
  const FractureModel model = bead_model(mesh, "none", 0.2);
  const Unknowns unknowns = place_unknowns(mesh, model);
  const StaggeredSettings tight{
      .damage_tolerance = 1e-7, .energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-8, .maximum_iterations = 5000};
  Staggered whole(mesh, model, unknowns, tight);
  const FractureState start = FractureRun(mesh, model, tight, {}).initial_state();
  FractureState state = start;
  state.load = 1.0;
  // Twice, as the weights of its gradients may lag behind the damage, which those of a window do not.
  ASSERT_TRUE(whole.solve_step(start, state, {}, {}).converged);
  ASSERT_TRUE(whole.solve_step(start, state, {}, {}).converged);
  ASSERT_GT(*std::ranges::max_element(state.damage.values()), 0.99);
  whole.renew_driving_energy(start, state);
  whole.damage_equation().renewed_fracture_energy(state.damage);
  const FaceField<Vector> face_displacement =
      whole.momentum().balance().mechanics(state.displacement).face_displacement;

  std::vector<Index> seeds;  // at the front
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (state.damage[c] > 0.5 && state.damage[c] < 0.9 && mesh.cell_centre[c].x() > 0.3) seeds.push_back(c);
  ASSERT_FALSE(seeds.empty());
  double damage = 0.0, displacement = 0.0;
  for (std::vector<Index>& cells : window_cells(mesh, seeds, 0.2)) {
    EXPECT_LT(static_cast<Index>(cells.size()), mesh.n_cells() / 2);
    FractureState after = state;
    Window window({.mesh = mesh,
                   .model = model,
                   .unknowns = unknowns,
                   .start = start,
                   .state = state,
                   .face_displacement = face_displacement,
                   .damage_equation = whole.damage_equation(),
                   .stiffness = whole.stiffness(),
                   .residual_reference = whole.momentum().residual_reference(),
                   .duration = 0.0},
                  cells, {.damage_tolerance = 1e-6, .equilibrium_tolerance = 1e-7, .maximum_iterations = 50});
    EXPECT_TRUE(window.settle(after).converged);
    for (const Index c : cells) {
      damage = std::max(damage, std::abs(after.damage[c] - state.damage[c]));
      if (state.damage[c] > 0.9) continue;  // a loose cell may be anywhere
      const Vector moved = after.displacement[as_size(c)] - state.displacement[as_size(c)];
      displacement = std::max(displacement, moved.norm() / 0.2);
    }
  }
  report_row("window at a front", {{"damage changes by", damage}, {"displacement by", displacement}});
  EXPECT_LE(damage, 1e-4);
  EXPECT_LE(displacement, 5e-4);
}

TEST(Windows, HoldTheCellsAroundTheSeedsInPartsThatDoNotTouch) {
  const Mesh mesh = bead();
  Index top = 0, bottom = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (mesh.cell_centre[c].z() > mesh.cell_centre[top].z()) top = c;
    if (mesh.cell_centre[c].z() < mesh.cell_centre[bottom].z()) bottom = c;
  }
  const auto apart = window_cells(mesh, {top, bottom}, 0.5);
  ASSERT_EQ(apart.size(), 2U);
  EXPECT_TRUE(std::ranges::binary_search(apart[0], top));
  EXPECT_TRUE(std::ranges::binary_search(apart[1], bottom));
  for (const auto& cells : apart) EXPECT_TRUE(std::ranges::is_sorted(cells));
  EXPECT_EQ(window_cells(mesh, {top, bottom}, 10.0).size(), 1U);
}

TEST(Windows, AreRefusedWithPressures) {
  const Mesh mesh = bead();
  FractureModel model = bead_model(mesh, "none", 0.1);
  for (RegionModel& region : model.regions) region.elasticity = from_young_poisson(75e6, 0.499);
  EXPECT_THROW(FractureRun(mesh, model, {.windows = true}, {}), InputError);
}

TEST(Windows, AreRefusedWhereTheLoadOfAStepIsNotKnown) {
  const Mesh mesh = bead();
  LoadingSettings loading;
  loading.maximum_dissipation = 1.0;
  EXPECT_THROW(FractureRun(mesh, bead_model(mesh, "none", 0.1), {.windows = true}, loading), InputError);
}

}  // namespace
}  // namespace pfdm::verification
