// A bead in a nearly incompressible binder, pulled until it debonds: the pressure that cells carry
// (solver/momentum/body/cell_pressure.h) while their stiffness is lost.

#include "tests/verification/bead.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm::verification::this_file {
namespace {

TEST(IncompressibleBinder, Debonds) {
  const Mesh mesh = sphere_in_cube(3, 6, 2.5, 0.6);
  FractureRun run(mesh, bead_model(mesh, "none", 0.32, 0.4999), {},
                  {.initial_increment = 0.2, .maximum_increment = 0.2, .stops = {}});
  std::vector<StepReport> steps;
  const auto step_done = [&](const FractureState&, const StepReport& report) { steps.push_back(report); };
  const FractureState end = run_to_end(run, step_done);
  const double krylov = double(run.krylov_iterations()) / run.staggered_iterations();
  const double before = steps[3].energy.external_work, stored = steps[3].energy.elastic + steps[3].energy.fracture;
  report_row(fmt::format("{} cells", mesh.n_cells()), {{"largest d", steps.back().max_damage},
                                                       {"damaged volume", steps.back().damaged_volume},
                                                       {"staggered iterations", run.staggered_iterations()},
                                                       {"Krylov iterations in each", krylov},
                                                       {"energies over the work before", stored / before}});
  EXPECT_DOUBLE_EQ(end.load, 1.0);
  EXPECT_GT(steps.back().max_damage, 0.99);
  EXPECT_GT(steps.back().damaged_volume, 0.0);
  // A slope of the pressures that reached from sound cells into broken ones took all of the 80 that there may be.
  EXPECT_LE(krylov, 25.0);
  EXPECT_LE(run.staggered_iterations(), 380);
  EXPECT_NEAR(stored / before, 1.0, 1e-2);
}

}  // namespace
}  // namespace pfdm::verification::this_file
