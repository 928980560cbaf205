// The program from end to end, on a bar that breaks.

#include "cases/program/listing.h"
#include "postproc/fields/pvd.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

nlohmann::json summary_in(const fs::path& results) {
  return nlohmann::json::parse(content_of(results / "summary.json"));
}

TEST(Program, RunsACaseAndWritesItsResults) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"run", directory.path().string(), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* file :
       {"summary.json", "force_displacement.csv", "fields.pvd", "mesh.vtu", "run.log", "checkpoint.bin"})
    EXPECT_TRUE(fs::exists(directory.results() / file)) << file;
  // Frames at the wanted displacement and at the end.
  const auto frames = fs::directory_iterator(directory.results() / "fields");
  EXPECT_EQ(std::distance(begin(frames), end(frames)), 2);
  const nlohmann::json summary = summary_in(directory.results());
  EXPECT_EQ(summary["status"], "complete");
  EXPECT_EQ(summary["cells"], 42);
  EXPECT_NEAR(summary["final_load"].get<double>(), 1.0, 1e-12);
  EXPECT_NE(outcome.out.find("step   10"), std::string::npos) << outcome.out;
  EXPECT_NE(content_of(directory.results() / "run.log").find("step   10"), std::string::npos);
}

TEST(Program, StartsAfreshWithoutRestart) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ASSERT_EQ(run({"run", directory.path().string(), "--max-steps", "1"}).status, 0);
  const auto frames = fs::directory_iterator(directory.results() / "fields");
  EXPECT_EQ(std::distance(begin(frames), end(frames)), 0);
  const std::string curve = content_of(directory.results() / "force_displacement.csv");
  EXPECT_EQ(std::count(curve.begin(), curve.end(), '\n'), 3);  // header, unloaded state, step 1
}

TEST(Program, SaysHowFarAFailedRunCame) {
  const std::string text = replaced(bar_case(), "maximum_increment = 0.1", "minimum_increment = 0.05");
  const TemporaryCase directory(text + "[solver]\nmaximum_iterations = 3\n");
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  const nlohmann::json summary = summary_in(directory.results());
  EXPECT_EQ(summary["status"].get<std::string>().substr(0, 7), "failed:");
  EXPECT_LT(summary["final_load"].get<double>(), 1.0);
  EXPECT_EQ(run({"run", directory.path().string(), "--restart"}).status, 1);
}

TEST(Program, ChecksWithoutWriting) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part : {"42 cells", "unknowns", "memory", "steps 10"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " is missing in " << outcome.out;
  EXPECT_FALSE(fs::exists(directory.results()));
}

TEST(Program, MeshesOnly) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"mesh", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("non-orthogonality"), std::string::npos);
  EXPECT_TRUE(fs::exists(directory.results() / "mesh.vtu"));
  EXPECT_FALSE(fs::exists(directory.results() / "force_displacement.csv"));
}

TEST(Program, SaysNothingWhenQuiet) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"run", directory.path().string(), "--quiet", "--max-steps", "1"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_FALSE(content_of(directory.results() / "run.log").empty());
}

TEST(Program, WarnsOnStandardErrorWhenQuiet) {
  const TemporaryCase coarse(replaced(bar_case(), "length = \"4 mm\"", "length = \"0.8 mm\""));
  const Outcome quiet = run({"run", coarse.path().string(), "--quiet", "--max-steps", "1"});
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(quiet.err.rfind("pfdm: warning: ", 0), 0u) << quiet.err;
  EXPECT_NE(content_of(coarse.results() / "run.log").find("warning: "), std::string::npos);
  const Outcome loud = run({"run", coarse.path().string(), "--max-steps", "1"});
  EXPECT_NE(loud.out.find("\nwarning: "), std::string::npos) << loud.out;
  EXPECT_EQ(loud.err, "");
}

TEST(Program, ReadsBoundaryExpressions) {
  const TemporaryCase directory(
      replaced(replaced(bar_case(), "\"0.015 mm\"", "{ expr = \"15*t\", unit = \"um\" }"), "\"0.006 mm\"", "0.4"));
  const TemporaryCase plain(bar_case());
  ASSERT_EQ(run({"run", directory.path().string(), "--max-steps", "3"}).status, 0);
  ASSERT_EQ(run({"run", plain.path().string(), "--max-steps", "3"}).status, 0);
  const nlohmann::json a = summary_in(directory.results());
  const nlohmann::json b = summary_in(plain.results());
  EXPECT_NEAR(a["final_force_N"].get<double>(), b["final_force_N"].get<double>(),
              1e-6 * std::abs(b["final_force_N"].get<double>()));
}

TEST(Program, ListsLawsAndCases) {
  const Outcome laws = run({"list", "--laws"});
  EXPECT_EQ(laws.status, 0);
  for (const char* name :
       {"AT1", "AT2", "quadratic", "volumetric_deviatoric", "symmetry", "box_hexes", "polyhedra", "vtk", "goodier"})
    EXPECT_NE(laws.out.find(name), std::string::npos) << name;
  const Outcome cases = run({"list"});
  EXPECT_EQ(cases.status, 0);
  EXPECT_NE(cases.out.find("glass_bead_quick"), std::string::npos) << cases.out;
}

TEST(Program, ListsKindsAndTimesOfCases) {
  const TemporaryCase directory(bar_case());
  fs::create_directories(directory.path() / "cases/ran");
  fs::create_directories(directory.path() / "cases/new");
  directory.write("cases/ran/case.toml", bar_case());
  directory.write("cases/new/case.toml", replaced(bar_case(), "a bar", "another bar"));
  ASSERT_EQ(run({"run", (directory.path() / "cases/ran").string()}).status, 0);
  std::ostringstream out;
  list_cases(directory.path() / "cases", out);
  EXPECT_THAT(out.str(), testing::MatchesRegex("new  fracture  +another bar\nran  fracture  +[0-9.]+ s  a bar\n"));
}

TEST(Program, HelpsAndTellsItsVersion) {
  EXPECT_EQ(run({"--help"}).status, 0);
  EXPECT_EQ(run({"run", "--help"}).status, 0);
  EXPECT_NE(run({"run", "--help"}).out.find("--restart"), std::string::npos);
  EXPECT_EQ(run({"--version"}).out.substr(0, 5), "pfdm ");
}

}  // namespace
}  // namespace pfdm::this_file
