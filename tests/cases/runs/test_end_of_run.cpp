// What a run tells when it ends: greatest force, first debonding, warnings, the next command.

#include "postproc/curves/instruction_set.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/glued_blocks.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

nlohmann::json summary_of(const TemporaryCase& directory) {
  return nlohmann::json::parse(content_of(directory.results() / "summary.json"));
}

// Linear softening from 2 MPa to zero at delta_f = 100 um, blocks that give 4 um at 2 MPa, steps of 12 um. At the
// displacement u the opening is (u - 4 um)/0.96; what it has dissipated, delta/delta_f of the toughness, passes 0.9025
// at u = 90.64 um, between 84 and 96 um, where 1/3 and 1/12 N act.
TEST(EndOfRun, TellsTheFirstDebondingOfAnInterface) {
  const TemporaryCase glued(glued_blocks(linear_glue + "name = \"glue\"\n"));
  const Outcome outcome = run({"run", glued.path().string(), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json summary = summary_of(glued);
  EXPECT_EQ(summary["first_debonding_surface"], "glue");
  EXPECT_NEAR(summary["first_debonding_displacement_m"].get<double>(), 84e-6, 1e-12);
  EXPECT_NEAR(summary["first_debonding_displacement_after_m"].get<double>(), 96e-6, 1e-12);
  EXPECT_NEAR(summary["first_debonding_force_N"].get<double>(), 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(summary["first_debonding_force_after_N"].get<double>(), 1.0 / 12.0, 1e-3);
  EXPECT_TRUE(summary["first_debonding_angle_deg"].is_null());  // a plane
  EXPECT_EQ(summary["instruction_set"], instruction_set());
  EXPECT_THAT(outcome.out, HasSubstr("First debonding of \"glue\" between 0.084 and 0.096 mm, where the force goes "
                                     "from 333.3 to 83.33 mN"));
  EXPECT_THAT(outcome.out, HasSubstr("Greatest force 1.833 N at 0.012 mm, with shorter steps up to 3.667 N ([loading] "
                                     "energy_release = 0.05); 0 N at the end, 0.12 mm."));
  EXPECT_THAT(outcome.out, HasSubstr("next: pfdm report " + glued.path().string()));
  EXPECT_THAT(outcome.out, HasSubstr("; 1 thread\n"));
  EXPECT_THAT(content_of(glued.results() / "run.log"), HasSubstr("First debonding of \"glue\""));
}

TEST(EndOfRun, KnowsTheFirstDebondingAfterARestart) {
  const TemporaryCase glued(glued_blocks(linear_glue + "name = \"glue\"\n"));
  const std::string place = glued.path().string();
  ASSERT_EQ(run({"run", place, "--max-steps", "4"}).status, 0);
  EXPECT_TRUE(summary_of(glued)["first_debonding_force_N"].is_null());
  EXPECT_FALSE(summary_of(glued).contains("first_debonding_surface"));
  ASSERT_EQ(run({"run", place, "--restart", "--max-steps", "5"}).status, 0);
  EXPECT_NEAR(summary_of(glued)["first_debonding_displacement_m"].get<double>(), 84e-6, 1e-12);
  ASSERT_EQ(run({"run", place, "--restart"}).status, 0);
  EXPECT_NEAR(summary_of(glued)["first_debonding_displacement_m"].get<double>(), 84e-6, 1e-12);
}

TEST(EndOfRun, SaysThatAllHolds) {
  const TemporaryCase glued(replaced(glued_blocks(linear_glue), "0.12 mm", "0.05 mm"));
  const Outcome outcome = run({"run", glued.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("No debonding: every surface holds"));
}

// What acts on a free patch is rounding, and nothing of it rises.
TEST(EndOfRun, OfAFreePatchIsItsDisplacement) {
  const std::string unnamed =
      replaced(glued_blocks(linear_glue), "patch = \"xmax\", component", "patch = \"ymax\", component");
  const std::string named = "\n[[boundary]]\npatch = \"ymax\"\ndisplacement = [\"free\", \"free\", \"free\"]\n";
  for (const std::string& text : {unnamed, unnamed + named}) {
    const TemporaryCase glued(text);
    const Outcome outcome = run({"run", glued.path().string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Displacement of \"ymax\" along x at the end 0.06 mm; it is free."));
    EXPECT_THAT(outcome.out, testing::Not(HasSubstr("Greatest force")));
  }
}

// The runs of a sweep record no columns, and know the first debonding all the same.
TEST(EndOfRun, IsInTheTableOfASweep) {
  const TemporaryCase glued(glued_blocks(linear_glue) + R"(
[sweep]
method = "list"
[[sweep.parameters]]
key = "interface[0].toughness"
values = ["100 J/m^2", "200 J/m^2"]
)");
  ASSERT_EQ(run({"sweep", glued.path().string()}).status, 0);
  const CsvTable table = read_csv(glued.results() / "sweep.csv", {.has_gaps = true});
  EXPECT_NEAR(table.column("first_debonding_displacement_m")[0], 84e-6, 1e-12);
  EXPECT_TRUE(std::isnan(table.column("first_debonding_displacement_m")[1]));  // 181 um
}

// A weak band across a bar: columns of cells in place of faces.
TEST(EndOfRun, TellsTheFirstDebondingOfColumns) {
  const TemporaryCase bar(bar_case() + crack_plane());
  const Outcome outcome = run({"run", bar.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = read_csv(bar.results() / "force_displacement.csv");
  const nlohmann::json summary = summary_of(bar);
  const auto row = static_cast<std::size_t>(
      std::ranges::find(curve.column("displacement_m"), summary["first_debonding_displacement_m"].get<double>()) -
      curve.column("displacement_m").begin());
  ASSERT_LT(row + 1, curve.n_rows());
  EXPECT_EQ(curve.column("force_x_N")[row], summary["first_debonding_force_N"].get<double>());
  EXPECT_LT(curve.column("max_damage")[row], 0.95);
  EXPECT_GT(curve.column("max_damage")[row + 1], 0.95);
  EXPECT_THAT(outcome.out, HasSubstr("First debonding of \"crack\" between "));
}

// All cells are thicker than ell/2, which is warned of when the run begins.
TEST(EndOfRun, RepeatsTheWarnings) {
  const TemporaryCase bar(replaced(bar_case(), "length = \"4 mm\"", "length = \"0.6 mm\""));
  const Outcome outcome = run({"run", bar.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::size_t begin = outcome.out.find("warning: ") + 9;
  const std::string warning = outcome.out.substr(begin, outcome.out.find('\n', begin) - begin);
  EXPECT_THAT(outcome.out, HasSubstr(" of this run:\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n  - " + warning + "\n"));
}

}  // namespace
}  // namespace pfdm::this_file
