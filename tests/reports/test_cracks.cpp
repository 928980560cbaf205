// What cracks cost, wherever they lie.

#include "tests/reports/reported_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm {
namespace {

using ::testing::HasSubstr;

double energy_at_the_end(const std::string& folder) {
  const ReportedCase reported(folder);
  const Outcome run = reported.run("run");
  EXPECT_EQ(run.status, 0) << run.err;
  return reported.json("summary.json")["final_fracture_energy_J"].get<double>();
}

// Once it has broken: one row of cells in the whole specimen, half a row in the half.
TEST(ReportedCracks, InAPlaneOfSymmetryHaveHalfOfTheEnergy) {
  const double whole = energy_at_the_end("35_crack_on_symmetry_plane/whole");
  EXPECT_NEAR(whole, 1.2 * 2700.0 * 0.5e-6, 0.03 * whole);
  EXPECT_NEAR(2.0 * energy_at_the_end("35_crack_on_symmetry_plane/half"), whole, 0.02 * whole);
}

// 0.8 mm at 0 and at 45 degrees to the rows of cells, ell = 4 h.
TEST(ReportedCracks, AcrossTheRowsHaveTheEnergyOfThoseAlongThem) {
  const double along = energy_at_the_end("34_oblique_initial_crack/0_degree");
  EXPECT_NEAR(energy_at_the_end("34_oblique_initial_crack/45_degree"), along, 0.03 * along);
}

TEST(ReportedCracks, KeepToRowsOfHexahedraAsCheckSays) {
  const Outcome check = ReportedCase("34_oblique_initial_crack/45_degree").run("check");
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("cost up to 2.6 % more than along them (ell/h = 4"));
}

}  // namespace
}  // namespace pfdm
