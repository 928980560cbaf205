// Meshes as other programs write them.

#include "tests/reports/reported_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm {
namespace {

// The right forces are those of finite elements: linear ones on the same mesh; ten-node tetrahedra, refined.
TEST(ReportedMeshes, HaveLineCellsAndNoSurfaces) {
  const ReportedCase bridge("02_vtk_line_cells");
  const Outcome run = bridge.run("run");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(bridge.json("summary.json")["peak_force_N"].get<double>(), 50298.0, 0.005 * 50298.0);
}

}  // namespace
}  // namespace pfdm
