// A run that stops goes on to the same results: curves, frames and energy release rates of a bar that breaks.

#include "postproc/fields/checkpoint.h"
#include "postproc/fields/pvd.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

nlohmann::json summary_in(const fs::path& results) {
  return nlohmann::json::parse(content_of(results / "summary.json"));
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

// Files with a right checksum: of a changed one, or of a program that erred.
TEST(Program, RefusesToGoOnFromWhatIsNoState) {
  const TemporaryCase directory(bar_case());
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place, "--max-steps", "2"}).status, 0);
  const fs::path file = directory.results() / "checkpoint.bin";
  const std::string hash = summary_in(directory.results())["case_hash"], good = content_of(file);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::function<void(FractureState&)> faults[] = {[](FractureState& s) { s.increment = 0.0; },
                                                        [](FractureState& s) { s.increment = -0.1; },
                                                        [](FractureState& s) { s.increment = nan; },
                                                        [](FractureState& s) { s.load = -0.1; },
                                                        [](FractureState& s) { s.load = infinity; },
                                                        [](FractureState& s) { s.step = -1; },
                                                        [](FractureState& s) { s.displacement[1][2] = nan; },
                                                        [](FractureState& s) { s.damage[0] = infinity; },
                                                        [](FractureState& s) { s.energy.elastic = nan; },
                                                        [](FractureState& s) { s.boundary_force[0][1] = -infinity; }};
  const std::string curve = content_of(directory.results() / "force_displacement.csv");
  for (const auto& fault : faults) {
    FractureState state = read_checkpoint(file, hash);
    fault(state);
    write_checkpoint(file, state, hash);
    const Outcome outcome = run({"run", place, "--restart"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("checkpoint.bin: this is no state of a run: "), std::string::npos) << outcome.err;
    EXPECT_EQ(content_of(directory.results() / "force_displacement.csv"), curve);
    directory.write("results/checkpoint.bin", good);
  }
  EXPECT_EQ(run({"run", place, "--restart"}).status, 0);
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

}  // namespace
}  // namespace pfdm::this_file
