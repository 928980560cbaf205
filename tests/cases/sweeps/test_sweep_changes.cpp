// Sweeps of changes: the case as it is, and with one change at a time.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

using testing::HasSubstr;

const std::string changes = R"(
[sweep]
method = "changes"
[sweep.changes]
"half the steps" = { "loading.initial_increment" = 0.05, "loading.maximum_increment" = 0.05 }
"twice as stiff" = { "materials.concrete.young_modulus" = "60 GPa" }
)";

TEST(SweepChanges, RunTheCaseAndEachChangeAlone) {
  const TemporaryCase directory(bar_case() + changes);
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 runs made, 0 reused"));
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  ASSERT_EQ(table.n_rows(), 3u);
  EXPECT_EQ(table.column("change"), (std::vector<double>{0.0, 1.0, 2.0}));
  const std::vector<double>&stiffness = table.column("initial_stiffness_N_per_m"), &peak = table.column("peak_force_N");
  EXPECT_NEAR(stiffness[1], stiffness[0], 1e-6 * stiffness[0]);
  EXPECT_NEAR(stiffness[2], 2.0 * stiffness[0], 1e-6 * stiffness[0]);
  EXPECT_GT(peak[1], peak[0]);  // steps of a tenth of the load tell the peak as well as they can
  EXPECT_NEAR(peak[2], std::sqrt(2.0) * peak[0], 0.25 * peak[0]);
  EXPECT_THAT(outcome.out, HasSubstr("initial stiffness 1.667 MN/m: half the steps 0 %, twice as stiff +100 %"));
  EXPECT_THAT(content_of(directory.results() / "sweep.csv"), HasSubstr("change, 1: half the steps"));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  EXPECT_EQ(peak[0], std::ranges::max(curve.column("force_x_N")));
  EXPECT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
  EXPECT_THAT(content_of(directory.results() / "report" / "sweep" / "index.html"),
              HasSubstr("peak force 17.41 N: half the steps 0 %, twice as stiff +38 %"));
}

TEST(SweepChanges, AreToldOnThePageOfTheRunThatTheyAreOf) {
  const TemporaryCase directory(bar_case() + changes);
  const auto page = [&] {
    EXPECT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
    EXPECT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
    return content_of(directory.results() / "report" / "index.html");
  };
  const std::string unknown = "One run does not tell what its mesh and steps do to it",
                    known =
                        "What changes of mesh and steps do to it, one at a time: peak force 17.41 N: half the steps";
  EXPECT_THAT(page(), HasSubstr(unknown));
  ASSERT_EQ(run({"sweep", directory.path().string(), "--quiet"}).status, 0);
  EXPECT_THAT(page(), HasSubstr(known));
  directory.write("case.toml", replaced(bar_case() + changes, "\"80 J/m^2\"", "\"60 J/m^2\""));
  EXPECT_THAT(page(), HasSubstr(unknown));
}

// As of a case that was copied, and has another mesh.
TEST(SweepChanges, OfKeysThatTheCaseHasNotDoNotStopARun) {
  const TemporaryCase directory(bar_case() + replaced(changes, "materials.concrete", "materials.steel"));
  EXPECT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const Outcome outcome = run({"sweep", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("[sweep.changes.twice as stiff]"));
}

TEST(SweepChanges, AreRefusedWithWhereAndWhy) {
  const auto complaint = [](const std::string& text) {
    const TemporaryCase directory(bar_case() + text);
    const Outcome outcome = run({"sweep", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  const std::string head = "\n[sweep]\nmethod = \"changes\"\n";
  EXPECT_THAT(complaint(head), HasSubstr("the method \"changes\" needs [sweep.changes]"));
  EXPECT_THAT(complaint(head + "changes = {}\n"), HasSubstr("at least one change is required"));
  EXPECT_THAT(complaint(head + "changes = { finer = {} }\n"), HasSubstr("name at least one key of the case"));
  EXPECT_THAT(complaint(head + "changes = { finer = { \"mesh.x[7].cells\" = 3 } }\n"), HasSubstr("mesh.x[7].cells"));
  EXPECT_THAT(complaint(changes + "[[sweep.parameters]]\nkey = \"fracture.length\"\nvalues = [\"4 mm\"]\n"),
              HasSubstr("takes [sweep.changes] alone"));
  EXPECT_THAT(complaint(replaced(changes, "\"changes\"", "\"grid\"")), HasSubstr("this needs method = \"changes\""));
}

}  // namespace
}  // namespace pfdm::this_file
