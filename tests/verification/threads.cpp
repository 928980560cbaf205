// A bead that debonds, at one, two and three threads: the same to the last bit, and in equilibrium at every step.

#include "solver/fracture_run.h"
#include "solver/parallel.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm::verification {
namespace {

FractureModel bead_model(const Mesh& mesh) {
  FractureModel model;
  for (const std::string& name : mesh.region_names)
    model.regions.push_back({.elasticity = name == "bead" ? from_young_poisson(70e9, 0.3) : from_young_poisson(75e6, 0.44),
                             .Gc = name == "bead" ? 1e7 : name == "interface" ? 1e5 : 1e6,  // radius 1 m
                             .ell = 0.2});
  model.crack = &crack_geometry("AT2");
  model.degradation = &degradation("quadratic");
  model.split = &energy_split("volumetric_deviatoric");
  BoundaryCondition pulled{.patch = "zmax", .displacement_prescribed = {false, false, true}, .value = {}};
  pulled.value = [](const Vector&, double t) { return Vector(0.0, 0.0, 0.2 * t); };
  model.boundary = {displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }), pulled};
  return model;
}

struct Outcome {
  FractureState state;
  std::vector<std::vector<Vector>> reactions;  // of every step, per patch
  double largest_imbalance = 0.0;              // |sum of reactions| over the largest reaction
};

Outcome debond(const Mesh& mesh, int threads) {
  set_threads(threads);
  FractureRun run(mesh, bead_model(mesh), {}, {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
  Outcome outcome;
  RunHooks hooks;
  hooks.step_done = [&](const FractureState&, const StepReport& report) {
    if (report.step == 0) return;
    outcome.reactions.push_back(report.reaction);
    Vector sum = Vector::Zero();
    double largest = 0.0;
    for (const Vector& force : report.reaction) {
      sum += force;
      largest = std::max(largest, force.norm());
    }
    outcome.largest_imbalance = std::max(outcome.largest_imbalance, sum.norm() / largest);
  };
  outcome.state = run.run(run.initial_state(), hooks);
  report_row(std::to_string(threads) + " threads",
             {{"staggered iterations", run.staggered_iterations()},
              {"krylov iterations", run.krylov_iterations()},
              {"largest d", *std::max_element(outcome.state.damage.begin(), outcome.state.damage.end())},
              {"largest imbalance of reactions", outcome.largest_imbalance}});
  set_threads(1);
  return outcome;
}

TEST(Threads, ChangeNothing) {
  const Mesh mesh = sphere_in_cube(4, 8, 2.5, 0.4);
  const Outcome alone = debond(mesh, 1);
  EXPECT_GT(*std::max_element(alone.state.damage.begin(), alone.state.damage.end()), 0.99);
  EXPECT_LE(alone.largest_imbalance, 1e-6);
  for (const int threads : {2, 3}) {
    const Outcome together = debond(mesh, threads);
    EXPECT_TRUE(together.state.displacement == alone.state.displacement) << threads;
    EXPECT_TRUE(together.state.damage == alone.state.damage) << threads;
    EXPECT_TRUE(together.state.boundary_force == alone.state.boundary_force) << threads;
    EXPECT_TRUE(together.reactions == alone.reactions) << threads;
  }
}

}  // namespace
}  // namespace pfdm::verification
