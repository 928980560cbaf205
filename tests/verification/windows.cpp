// Windows, in which the staggered loop goes on around the cells that change: a solution of the whole is one of a
// window, and a bead debonds with them as without, in fewer iterations of the whole.

#include "physics/error.h"
#include "solver/fracture/window.h"
#include "solver/parallel.h"
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
  const auto step_done = [&](const FractureState&, const StepReport& report) {
    const auto top = &mesh.patch("zmax") - mesh.patches.data();
    outcome.force.push_back(report.reaction[static_cast<std::size_t>(top)].z());
    outcome.fracture_energy.push_back(report.energy.fracture);
  };
  outcome.state = run_to_end(run, step_done);
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

// A bead with a crack at rest.
class AtRest {
 public:
  AtRest() {
    state = start_;
    state.load = 1.0;
    // Twice, as the weights of its gradients may lag behind the damage, which those of a window do not.
    for (int turn = 0; turn < 2; ++turn) is_settled = whole_.solve_step(start_, state).converged;
    whole_.damage_equation().renewed_fracture_energy(state.damage);
  }

  std::vector<std::vector<Index>> windows_at_front() const {
    std::vector<Index> seeds;
    for (Index c = 0; c < mesh.n_cells(); ++c)
      if (state.damage[c] > 0.5 && state.damage[c] < 0.9 && mesh.cell_centre[c].x() > 0.3) seeds.push_back(c);
    return window_cells(mesh, seeds, 0.2);
  }

  // Whether it converged.
  bool settle(const std::vector<Index>& cells, FractureState& after) {
    Window window(whole_, {start_, state, state.damage, 0.0, 0.0}, cells,
                  {.damage_tolerance = 1e-6, .equilibrium_tolerance = 1e-7, .maximum_iterations = 50});
    return window.settle(after).converged;
  }

  // Of the displacement, over the reach; a loose cell may be anywhere.
  double moved_by(const std::vector<Index>& cells, const FractureState& after) const {
    double largest = 0.0;
    for (const Index c : cells)
      if (state.damage[c] <= 0.9)
        largest = std::max(largest, (after.displacement[as_size(c)] - state.displacement[as_size(c)]).norm() / 0.2);
    return largest;
  }

  const Mesh mesh = bead();
  FractureState state;
  bool is_settled = false;

 private:
  const FractureModel model_ = bead_model(mesh, "none", 0.2);
  const Unknowns unknowns_ = place_unknowns(mesh, elastic_body(model_));
  const StaggeredSettings tight_{
      .damage_tolerance = 1e-7, .energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-8, .maximum_iterations = 5000};
  Staggered whole_{mesh, model_, unknowns_, tight_};
  FractureState start_ = FractureRun(mesh, model_, tight_, {}).initial_state();
};

// With broken cells at the cut.
TEST(Windows, LeaveASolutionOfTheWholeAsItIs) {
  AtRest body;
  ASSERT_TRUE(body.is_settled);
  ASSERT_GT(*std::ranges::max_element(body.state.damage.values()), 0.99);
  const auto windows = body.windows_at_front();
  ASSERT_FALSE(windows.empty());
  double damage = 0.0, displacement = 0.0;
  for (const std::vector<Index>& cells : windows) {
    EXPECT_LT(static_cast<Index>(cells.size()), body.mesh.n_cells() / 2);
    FractureState after = body.state;
    EXPECT_TRUE(body.settle(cells, after));
    for (const Index c : cells) damage = std::max(damage, std::abs(after.damage[c] - body.state.damage[c]));
    displacement = std::max(displacement, body.moved_by(cells, after));
  }
  report_row("window at a front", {{"damage changes by", damage}, {"displacement by", displacement}});
  EXPECT_LE(damage, 1e-4);
  EXPECT_LE(displacement, 5e-4);
}

// The forces at the cut are those of the cells as they were.
TEST(Windows, AreNotTornByCellsThatBreakAtTheCut) {
  AtRest body;
  ASSERT_TRUE(body.is_settled);
  double displacement = 0.0;
  Index n_broken = 0;
  for (const std::vector<Index>& cells : body.windows_at_front()) {
    FractureState after = body.state;
    const auto is_outside = [&](Index f, Index c) {
      return body.mesh.is_interior(f) && !std::ranges::binary_search(cells, body.mesh.across(f, c));
    };
    for (const Index c : cells)
      if (after.damage[c] > 0.1 && after.damage[c] < 0.9 &&
          std::ranges::any_of(body.mesh.faces_of_cell(c), [&](Index f) { return is_outside(f, c); }))
        after.damage[c] = 1.0, ++n_broken;
    EXPECT_TRUE(body.settle(cells, after));
    displacement = std::max(displacement, body.moved_by(cells, after));
  }
  report_row("cells broken at the cut", {{"cells", n_broken}, {"displacement changes by", displacement}});
  EXPECT_GT(n_broken, 0);
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
