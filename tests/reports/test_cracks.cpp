// What cracks cost, wherever they lie.

#include "tests/reports/reported_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
  EXPECT_THAT(check.out, HasSubstr("cost up to 2.6 % more than along them where cells are smallest (ell/h = 4"));
}

// AT1, 25 ell long: it softens everywhere from 39.5 um on, where a real bar breaks.
TEST(ReportedCracks, InAUniformBarAreMissedWithAWarning) {
  const ReportedCase bar("39_uniform_bar/uniform");
  const Outcome run = bar.run("run");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("this equilibrium is unstable"));
  EXPECT_THAT(run.out, HasSubstr("fracture.perturbation"));
}

// Strength (3 E Gc/(8 ell))^(1/2) times 5 mm^2. It breaks at an end, where nothing holds the damage and half of a
// profile will do: half of 500 uJ, and what was damaged evenly before.

// Its ends hold it across too: the strain is not even, and one crack takes all.
TEST(ReportedCracks, BreakABarWithHeldEnds) {
  const ReportedCase bar("39_uniform_bar/clamped");
  const Outcome run = bar.run("run");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("unstable")));
  const auto summary = nlohmann::json::parse(content_of(bar.results() / "summary.json"));
  EXPECT_NEAR(summary["peak_force_N"].get<double>(), 118.6, 0.035 * 118.6);
  EXPECT_NEAR(summary["final_fracture_energy_J"].get<double>(), 500e-6, 5e-6);
  EXPECT_LT(summary["final_force_N"].get<double>(), 0.01 * 118.6);
}

TEST(ReportedCracks, BreakAUniformBarThatIsPerturbed) {
  const ReportedCase uniform("39_uniform_bar/uniform");
  std::string text = content_of(uniform.path() / "case.toml");
  text = replaced(text, "split = \"none\"", "split = \"none\"\nperturbation = 0.01");
  text = replaced(text, "100 um", "41 um");
  text = replaced(text, "initial_increment = 0.02\nmaximum_increment = 0.02",
                  "initial_increment = 0.01\nmaximum_increment = 0.01");
  const TemporaryCase bar(text);
  const Outcome run = pfdm::run({"run", bar.path().string()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("unstable")));
  const auto summary = nlohmann::json::parse(content_of(bar.results() / "summary.json"));
  EXPECT_NEAR(summary["peak_force_N"].get<double>(), 118.6, 0.01 * 118.6);
  EXPECT_NEAR(summary["final_fracture_energy_J"].get<double>(), 265e-6, 15e-6);
  EXPECT_LT(summary["final_force_N"].get<double>(), 0.01 * 118.6);
}

}  // namespace
}  // namespace pfdm::this_file
