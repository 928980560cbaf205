// Sweeps of changes: the case as it is, and with one change at a time.

#include "cases/program/studies/sweep/shown_columns.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_case.h"
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
  const std::string page = content_of(directory.results() / "report" / "sweep" / "index.html"),
                    line = "peak force 17.41 N: half the steps 0 %, twice as stiff +38 %";
  EXPECT_THAT(page, HasSubstr(line));
  EXPECT_EQ(page.find(line), page.rfind(line)) << "told twice";
  EXPECT_THAT(page, HasSubstr("The sweep has 3 runs, 3 of them converged."));
  EXPECT_THAT(page, HasSubstr("What one of its changes does at most: peak force +38 % (twice as stiff)"));
  EXPECT_THAT(page, testing::Not(HasSubstr("change=")));
  EXPECT_THAT(outcome.out, HasSubstr("run 3: twice as stiff (materials.concrete.young_modulus = 60 GPa)"));
}

// What is said of debonding and of the law depends on the surfaces.
TEST(SweepChanges, AreRunAgainWithOtherSurfaces) {
  const TemporaryCase directory(bar_case() + crack_plane() + changes);
  ASSERT_EQ(run({"sweep", directory.path().string(), "--quiet"}).status, 0);
  const double wide =
      read_csv(directory.results() / "sweep.csv", {.has_gaps = true}).column("cohesive_energy_J_per_m2")[0];
  directory.write("case.toml", replaced(bar_case() + crack_plane() + changes, "\"30 mm\"", "\"0.4 mm\""));
  const Outcome outcome = run({"sweep", directory.path().string()});
  EXPECT_THAT(outcome.out, HasSubstr("3 runs made, 0 reused"));
  EXPECT_LT(read_csv(directory.results() / "sweep.csv", {.has_gaps = true}).column("cohesive_energy_J_per_m2")[0],
            wide);
}

TEST(SweepChanges, OfOtherKindsOfCaseAreToldOfWhatDiffers) {
  const TemporaryCase directory(tension_case() + R"(
[sweep]
method = "changes"
[sweep.changes]
"ten times the steps" = { "loading.segments[0].increments" = 100 }
)");
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex("largest stress xx [0-9.]+ MPa: ten times the steps [+-]"));
}

TEST(SweepChanges, OfABoxAreToldOfStressAndStrain) {
  CsvTable table;
  for (const char* name : {"peak_force_N", "first_debonding_stress_zz_Pa", "first_debonding_stress_zz_after_Pa",
                           "initial_modulus_zz_Pa", "peak_stress_zz_Pa", "strain_zz_at_peak"})
    table.add(name, {});
  EXPECT_THAT(headline_columns(table), testing::ElementsAre(4u, 5u, 1u, 3u));
  table.names[4] = "final_stress_zz_Pa";
  EXPECT_THAT(headline_columns(table), testing::ElementsAre(0u));
}

TEST(SweepChanges, AreToldOnThePageOfTheRunThatTheyAreOf) {
  const TemporaryCase directory(bar_case() + changes);
  const auto page = [&] {
    EXPECT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
    EXPECT_EQ(run({"report", directory.path().string(), "--quiet"}).status, 0);
    return content_of(directory.results() / "report" / "index.html");
  };
  const std::string unknown = "One run does not tell what its mesh and steps do to it",
                    known = "What the changes of its sweep do to it, one at a time: peak force 17.41 N: half the steps";
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
