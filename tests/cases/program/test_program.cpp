// The program from end to end, on a bar that breaks.

#include "cases/program/listing.h"
#include "postproc/fields/pvd.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

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

/// The bar breaks in steps of a twentieth of what its crack takes: past snap-back.
std::string followed_bar_case() {
  const std::string text = replaced(bar_case(), "frames_at = [\"0.006 mm\"]", "frames_every = 2");
  return replaced(text, "maximum_increment = 0.1", "maximum_increment = 0.1\nmaximum_dissipation = \"4 uJ\"");
}

void expect_to_go_on_to_the_same_curve(const std::string& text, const std::string& first_steps = "4") {
  const TemporaryCase directory(text);
  const std::string place = directory.path().string();
  const fs::path whole = directory.path() / "whole";
  const fs::path broken = directory.path() / "broken";
  ASSERT_EQ(run({"run", place, "--output", whole.string()}).status, 0);
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--max-steps", first_steps}).status, 0);
  EXPECT_EQ(summary_in(broken)["status"], "stopped by --max-steps");
  EXPECT_NE(content_of(broken / "force_displacement.csv"), content_of(whole / "force_displacement.csv"));
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart", "--max-steps", "3"}).status, 0);
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart"}).status, 0);
  EXPECT_EQ(content_of(broken / "force_displacement.csv"), content_of(whole / "force_displacement.csv"));
  EXPECT_EQ(content_of(broken / "fields.pvd"), content_of(whole / "fields.pvd"));
  EXPECT_EQ(content_of(broken / "checkpoint.bin"), content_of(whole / "checkpoint.bin"));
  EXPECT_EQ(content_of(broken / "energy_release_rate.csv"), content_of(whole / "energy_release_rate.csv"));
  EXPECT_EQ(summary_in(broken)["status"], "complete");
}

TEST(Program, GoesOnToTheSameCurveAsAnUnbrokenRun) { expect_to_go_on_to_the_same_curve(bar_case()); }

/// The bar with an energy release rate measured around its middle, which breaks, and one beyond its end.
std::string measured_bar_case() {
  return bar_case() + R"([[output.energy_release_rate]]
name = "middle"
point = ["10 mm", "0.5 mm", "0.5 mm"]
direction = [0, 1, 0]
tip = "foremost"
inner = "0.1 mm"
outer = "0.4 mm"
reference_length = "1 mm"
[[output.energy_release_rate]]
name = "end"
point = ["20 mm", "0.5 mm", "0.5 mm"]
direction = [1, 0, 0]
inner = "0.1 mm"
outer = "1 mm"
)";
}

/// The bar with a viscosity that takes part in its energy account.
std::string viscous_bar_case() {
  return replaced(replaced(bar_case(), "length = \"4 mm\"", "length = \"4 mm\"\nviscosity = \"5 kPa s\""),
                  "maximum_increment = 0.1", "maximum_increment = 0.1\nduration = \"1 s\"");
}

TEST(Program, AccountsForViscousDissipation) {
  expect_to_go_on_to_the_same_curve(viscous_bar_case());
  const TemporaryCase directory(viscous_bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  EXPECT_GT(summary_in(directory.results())["viscous_dissipation_J"].get<double>(), 0.0);
  const std::string dissipated = replaced(viscous_bar_case(), "duration", "maximum_dissipation = \"4 uJ\"\nduration");
  const TemporaryCase refused(replaced(dissipated, "frames_at = [\"0.006 mm\"]", ""));
  const Outcome outcome = run({"run", refused.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("maximum_dissipation: it cannot be combined with fracture.viscosity"), std::string::npos)
      << outcome.err;
}

TEST(Program, WritesEnergyReleaseRatesAtEveryStep) {
  const TemporaryCase directory(measured_bar_case());
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = content_of(directory.results() / "energy_release_rate.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "step,load,middle_tip_x_m,middle_tip_y_m,middle_tip_z_m,middle_G_J_per_m2,middle_damaged_share,"
            "middle_K1_Pa_sqrt_m,middle_K2_Pa_sqrt_m,middle_phase_angle_degree,"
            "end_tip_x_m,end_tip_y_m,end_tip_z_m,end_G_J_per_m2,end_damaged_share");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 12);
  EXPECT_NE(table.find(",nan,"), std::string::npos);
  EXPECT_NE(outcome.out.find("energy release rate \"end\""), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("energy release rate \"middle\""), std::string::npos) << outcome.out;
  const nlohmann::json summary = summary_in(directory.results());
  EXPECT_TRUE(summary["final_middle_G_J_per_m2"].is_number());
  EXPECT_TRUE(summary["final_end_G_J_per_m2"].is_null());
  EXPECT_TRUE(summary["final_middle_K2_Pa_sqrt_m"].is_number());
  EXPECT_TRUE(summary["final_middle_phase_angle_degree"].is_number());
  expect_to_go_on_to_the_same_curve(measured_bar_case());
}

TEST(Program, GoesOnAlongTheSamePathAsAnUnbrokenRun) {
  expect_to_go_on_to_the_same_curve(followed_bar_case());
  expect_to_go_on_to_the_same_curve(followed_bar_case(), "18");  // from beyond the snap-back
}

TEST(Program, GivesFramesTimesThatRiseWhereTheLoadFallsBack) {
  const TemporaryCase directory(followed_bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const std::vector<double> loads = read_csv(directory.results() / "force_displacement.csv").column("load");
  EXPECT_FALSE(std::ranges::is_sorted(loads));
  const std::vector<Frame> frames = read_pvd(directory.results() / "fields.pvd");
  EXPECT_GT(frames.size(), loads.size() / 2);
  EXPECT_TRUE(std::ranges::is_sorted(frames, std::ranges::less{}, &Frame::time));
}

// A bar of about a hundred polyhedra that breaks.
std::string bar_of_polyhedra() {
  std::string text = bar_case();
  const std::size_t begin = text.find("generator"), end = text.find("[materials.concrete]");
  text.replace(begin, end - begin, R"(generator = "particles_in_box"
cells = "polyhedra"
size = ["10 mm", "2 mm", "2 mm"]
size_far = "1.4 mm"
region = "bar"

)");
  text = replaced(text, "regions = [\"bar\", \"weak\"]", "regions = [\"bar\"]");
  text = replaced(text, "[regions.weak]\ntoughness = \"80 J/m^2\"\n", "");
  return replaced(text, "type = \"plane\"", "type = \"symmetry\"");
}

TEST(Program, GoesOnWithPolyhedra) { expect_to_go_on_to_the_same_curve(bar_of_polyhedra()); }

TEST(Program, WritesPolyhedra) {
  const TemporaryCase directory(bar_of_polyhedra());
  const Outcome outcome = run({"mesh", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(" polyhedra\n"), std::string::npos) << outcome.out;
  EXPECT_TRUE(fs::exists(directory.results() / "mesh.vtu"));
}

TEST(Program, TakesRowsBeyondTheCheckpointAway) {
  const TemporaryCase directory(bar_case());
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place, "--max-steps", "4"}).status, 0);
  const std::string checkpoint = content_of(directory.results() / "checkpoint.bin");
  ASSERT_EQ(run({"run", place, "--restart"}).status, 0);
  const std::string curve = content_of(directory.results() / "force_displacement.csv");
  directory.write("results/checkpoint.bin", checkpoint);  // as if killed between row and checkpoint
  fs::remove(directory.results() / "summary.json");
  ASSERT_EQ(run({"run", place, "--restart"}).status, 0);
  EXPECT_EQ(content_of(directory.results() / "force_displacement.csv"), curve);
}

TEST(Program, RestartsWhatIsCompleteByDoingNothing) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const std::string summary = content_of(directory.results() / "summary.json");
  const Outcome again = run({"run", directory.path().string(), "--restart"});
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.out.find("complete already"), std::string::npos);
  EXPECT_EQ(content_of(directory.results() / "summary.json"), summary);
}

TEST(Program, RefusesToGoOnWithAnotherCase) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string(), "--max-steps", "2"}).status, 0);
  const std::string curve = content_of(directory.results() / "force_displacement.csv");
  directory.write("case.toml", replaced(bar_case(), "30 GPa", "31 GPa"));
  const Outcome outcome = run({"run", directory.path().string(), "--restart"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("checkpoint.bin"), std::string::npos) << outcome.err;
  EXPECT_EQ(content_of(directory.results() / "force_displacement.csv"), curve);
}

// A run that failed for want of iterations is not lost: the solver's settings and the loading may change.
TEST(Program, GoesOnWithOtherSettingsOfTheSolver) {
  const TemporaryCase directory(bar_case() + "[solver]\nmaximum_iterations = 3\n");
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place}).status, 1);
  const double reached = summary_in(directory.results())["final_load"].get<double>();
  ASSERT_GT(reached, 0.0);
  directory.write("case.toml", "# with more iterations\n" + bar_case() + "[solver]\nmaximum_iterations = 500\n");
  const Outcome outcome = run({"run", place, "--restart"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("continuing after step"), std::string::npos) << outcome.out;
  EXPECT_EQ(summary_in(directory.results())["status"], "complete");
}

// 1 mm over 50 is a little more than 20 um in double precision.
TEST(Program, DoesNotWarnOfCellsOfHalfTheLength) {
  const TemporaryCase plate(R"(kind = "fracture"
title = "a plate"
boundary = [{ patch = "ymin", displacement = ["0 mm", "0 mm", "free"] },
            { patch = "ymax", displacement = ["free", "8 um", "free"] },
            { patches = ["zmin", "zmax"], type = "plane" }]
mesh.generator = "box_hexes"
mesh.x = [{ length = "1 mm", cells = 50 }]
mesh.y = [{ length = "1 mm", cells = 50 }]
mesh.z = [{ length = "1 mm", cells = 1 }]
[materials.steel]
regions = ["body"]
young_modulus = "210 GPa"
poisson_ratio = 0.3
toughness = "2.7 kJ/m^2"
[fracture]
length = "40 um"
[output]
curve = { patch = "ymax", component = "y" }
)");
  const Outcome outcome = run({"check", plate.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("would not be resolved"), std::string::npos) << outcome.out;
}

// A band is as thin as wanted, but its columns are two ell wide.
TEST(Program, WarnsOfCellsThatAreTooWideAlongABand) {
  const auto bead = [](const std::string& size) {
    return R"(kind = "fracture"
title = "a bead"
boundary = [{ patch = "zmin", displacement = ["0 um", "0 um", "0 um"] },
            { patch = "zmax", displacement = ["free", "free", "1 um"] }]
[mesh]
generator = "particles_in_box"
size = ["200 um", "200 um", "200 um"]
particles = [{ diameter = "80 um", surface_size = )" +
           size + R"( }]
layers = { count = 4, thickness = "4 um" }
[materials.sylgard]
regions = ["matrix", "interface", "bead"]
young_modulus = "75 MPa"
poisson_ratio = 0.44
toughness = "400 J/m^2"
[fracture]
length = "10 um"
effective_toughness = "as_given"
[output]
curve = { patch = "zmax", component = "z" }
)";
  };
  const auto check_of = [&](const std::string& size) {
    const TemporaryCase directory(bead(size));
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_NE(check_of("\"20 um\"").find("wide along the band"), std::string::npos);
  EXPECT_EQ(check_of("\"9 um\"").find("wide along the band"), std::string::npos);
  const auto cells_of = [](const std::string& text) { return text.substr(text.find("\ncells "), 20); };
  EXPECT_EQ(cells_of(check_of("{ ell = 0.9 }")), cells_of(check_of("\"9 um\"")));
  expect_refused(TemporaryCase(replaced(bead("{ ell = 0.9 }"), "length = \"10 um\"\n", "")),
                 {"NoEll", "", "", {"surface_size", "[fracture]"}});
}

TEST(Program, WarnsOfCellsThatAreTooThickForTheLength) {
  const TemporaryCase fine(bar_case()), coarse(replaced(bar_case(), "\"4 mm\"", "\"0.6 mm\""));
  EXPECT_EQ(run({"check", fine.path().string()}).out.find("would not be resolved"), std::string::npos);
  const Outcome outcome = run({"check", coarse.path().string()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("region \"bar\": cells are up to 500 um thick, ell is 600 um"), std::string::npos)
      << outcome.out;
}

/// Cells of 0.2 mm in the middle, where the bar breaks, and 2 mm elsewhere, all 0.5 mm across; ell is 0.6 mm.
std::string graded_bar() {
  std::string text =
      replaced(bar_case(), "{ length = \"20 mm\", cells = 21 }",
               "{ length = \"8 mm\", cells = 4 }, { length = \"4 mm\", cells = 20 }, { length = \"8 mm\", "
               "cells = 4 }");
  return replaced(replaced(text, "\"4 mm\"\n\n", "\"0.6 mm\"\n\n"), "\"80 J/m^2\"", "\"8 J/m^2\"");
}

TEST(Program, DoesNotWarnOfCoarseCellsThatNoCrackEnters) {
  const TemporaryCase fine(graded_bar());
  const Outcome within = run({"run", fine.path().string()});
  ASSERT_EQ(within.status, 0) << within.err;
  EXPECT_THAT(within.out, ::testing::HasSubstr("region \"bar\": cells are up to 500 um thick, ell is 600 um: a crack "
                                               "is resolved in 32 of 48 cells"));
  EXPECT_THAT(within.out, ::testing::Not(::testing::HasSubstr("warning")));
}

TEST(Program, WarnsOfABandThatIsNarrowerThanItsCracksProfile) {
  const TemporaryCase directory(replaced(bar_case(), "toughness = \"80 J/m^2\"\n",
                                         "toughness = \"80 J/m^2\"\nband = { width = \"0.8 mm\", between = [\"bar\", "
                                         "\"bar\"] }\n"));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("region \"weak\" is 800 um wide: the profile of a crack in it, 16 mm"), std::string::npos)
      << outcome.out;
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
