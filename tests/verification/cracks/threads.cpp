// A bead that debonds, at one, two and three threads and on every processor: the same to the last bit, and in
// equilibrium at every step.

#include "solver/parallel.h"
#include "tests/mesh/checksum.h"
#include "tests/verification/bead.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm::verification::this_file {
namespace {

struct Outcome {
  FractureState state;
  std::vector<std::vector<Vector>> reactions;  // of every step, per patch
  double largest_imbalance = 0.0;              // |sum of reactions| over the largest reaction
};

Outcome debond(const Mesh& mesh, int threads) {
  set_threads(threads);
  FractureRun run(mesh, bead_model(mesh, "volumetric_deviatoric", 0.2), {.equilibrium_tolerance = 1e-7},
                  {.initial_increment = 0.25, .maximum_increment = 0.25, .stops = {}});
  Outcome outcome;
  const auto step_done = [&](const FractureState&, const StepReport& report) {
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
  outcome.state = run_to_end(run, step_done);
  report_row(std::to_string(threads) + " threads",
             {{"staggered iterations", run.staggered_iterations()},
              {"krylov iterations", run.krylov_iterations()},
              {"largest d", *std::max_element(outcome.state.damage.begin(), outcome.state.damage.end())},
              {"largest imbalance of reactions", outcome.largest_imbalance}});
  set_threads(1);
  return outcome;
}

std::uint64_t checksum(const FractureState& state) {
  Checksum sum;
  for (const Vector& u : state.displacement) sum.add(u);
  for (const double d : state.damage) sum.add(d);
  return sum.sum();
}

TEST(Threads, ChangeNothing) {
  const Mesh mesh = sphere_in_cube(4, 8, 2.5, 0.4);
  const Outcome alone = debond(mesh, 1);
  EXPECT_GT(*std::max_element(alone.state.damage.begin(), alone.state.damage.end()), 0.99);
  EXPECT_LE(alone.largest_imbalance, 1e-6);
#if defined(__x86_64__)
  EXPECT_EQ(checksum(alone.state), 7620360186962194847U);  // with AVX2, AVX-512 or neither
#endif
  for (const int threads : {2, 3}) {
    const Outcome together = debond(mesh, threads);
    EXPECT_TRUE(together.state.displacement == alone.state.displacement) << threads;
    EXPECT_TRUE(together.state.damage == alone.state.damage) << threads;
    EXPECT_TRUE(together.state.boundary_force == alone.state.boundary_force) << threads;
    EXPECT_TRUE(together.reactions == alone.reactions) << threads;
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
