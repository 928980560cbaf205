// Ctrl-C and SIGTERM, on the program itself.

#include "cases/program/session/terminal/external_program.h"
#include "tests/cases/endochronic_case.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string bar_in_steps_of(const std::string& increment) {
  return replaced(replaced(bar_case(), "initial_increment = 0.1", "initial_increment = " + increment),
                  "maximum_increment = 0.1", "maximum_increment = " + increment);
}

/// Starts the program in a process group of its own, as a terminal would, and sends the whole group the signal as soon
/// as there is `file` with at least so many lines.
ProgramEnd interrupted(const std::string& words, const std::string& signal, const fs::path& file, int lines) {
  const std::string script = fmt::format(
      "exec 3>&2 2>/dev/null\n"  // where bash tells of its jobs
      "set -m\n"
      "{} {} --threads 2 2>&3 &\n"
      "while ! [ \"$(cat {} 2>/dev/null | wc -l)\" -ge {} ]; do sleep 0.02; kill -0 $! || break; done\n"
      "kill -{} -- -$!\n"
      "wait $!\n",
      PFDM_PROGRAM, words, file.string(), lines, signal);
  return run_external({"bash", "-c", script});
}

class Interruption : public testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(Interruption, LeavesARunThatGoesOnToTheSameCurve) {
  const TemporaryCase directory(bar_in_steps_of("0.01"));
  const std::string place = directory.path().string();
  const fs::path curve = directory.results() / "force_displacement.csv";
  const auto [signal, status] = GetParam();
  const ProgramEnd end = interrupted("run " + place, signal, curve, 20);
  EXPECT_EQ(end.status, status) << end.err;
  EXPECT_THAT(end.err, HasSubstr("pfdm: interrupted at step "));
  EXPECT_THAT(end.err, HasSubstr("results in " + directory.results().string() + "; pfdm run " + place + " --restart"));
  EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
  EXPECT_THAT(content_of(directory.results() / "summary.json"), HasSubstr("\"status\": \"interrupted\""));
  ASSERT_EQ(run_external({PFDM_PROGRAM, "run", place, "--restart"}).status, 0);
  const std::string gone_on = content_of(curve);
  ASSERT_EQ(run_external({PFDM_PROGRAM, "run", place}).status, 0);
  EXPECT_EQ(content_of(curve), gone_on);
}

TEST_P(Interruption, LeavesASweepThatGoesOn) {
  const TemporaryCase directory(
      bar_in_steps_of("0.002") + "\n[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\n" +
      "key = \"materials.concrete.young_modulus\"\nvalues = [\"30 GPa\", \"35 GPa\", \"40 GPa\"]\n");
  const std::string place = directory.path().string();
  const auto [signal, status] = GetParam();
  const ProgramEnd end = interrupted("sweep " + place, signal, directory.results() / "runs/*/case.toml", 1);
  EXPECT_EQ(end.status, status) << end.err;
  EXPECT_EQ(end.err, "pfdm: interrupted; what has been computed is kept, and the same command continues it\n");
  EXPECT_FALSE(fs::exists(directory.results() / "sweep.csv"));
  EXPECT_EQ(run_external({PFDM_PROGRAM, "sweep", place}).status, 0);
  EXPECT_TRUE(fs::exists(directory.results() / "sweep.csv"));
}

/// A run that goes on from its checkpoint is refused, and nothing changes in its results.
void expect_no_restart(const TemporaryCase& directory, const std::string& message) {
  const std::string checkpoint = content_of(directory.results() / "checkpoint.bin");
  const ProgramEnd end = run_external({PFDM_PROGRAM, "run", directory.path().string(), "--restart"});
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr(message));
  EXPECT_THAT(end.err, HasSubstr("without --restart the run starts anew"));
  EXPECT_EQ(content_of(directory.results() / "checkpoint.bin"), checkpoint);
}

TEST(Restart, WantsEveryStepOfTheCurve) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run_external({PFDM_PROGRAM, "run", directory.path().string()}).status, 0);
  const fs::path curve = directory.results() / "force_displacement.csv";
  const std::string whole = content_of(curve);
  const std::size_t last_row = whole.rfind('\n', whole.size() - 2) + 1;
  directory.write("results/force_displacement.csv", whole.substr(0, last_row));
  expect_no_restart(directory, "force_displacement.csv: step 10 is missing, although the checkpoint beside it is of ");
  fs::remove(curve);
  expect_no_restart(directory, "force_displacement.csv: step 0 is missing");
  EXPECT_FALSE(fs::exists(curve));
  directory.write("results/force_displacement.csv", whole);
  EXPECT_EQ(run_external({PFDM_PROGRAM, "run", directory.path().string(), "--restart"}).status, 0);
}

TEST(Restart, WantsTheRecordOfItsColumns) {
  const TemporaryCase directory(bar_case() + crack_plane());
  ASSERT_EQ(run_external({PFDM_PROGRAM, "run", directory.path().string()}).status, 0);
  const fs::path step = directory.results() / "columns/crack/step_000004.csv";
  ASSERT_TRUE(fs::exists(step));
  const std::string whole = content_of(step);
  directory.write("results/columns/crack/step_000004.csv", whole.substr(0, whole.size() / 2));
  expect_no_restart(directory, "step_000004.csv");
  fs::remove(step);
  expect_no_restart(directory, "columns/crack");
}

std::string shaken_for(const std::string& duration) {
  return soft_sample() +
         "[[test]]\nname = \"up\"\nexcitation = { type = \"swept_sine\", level = \"1 g0\", from = \"10 Hz\", "
         "to = \"100 Hz\", duration = \"" +
         duration + "\" }\n";
}

/// Runs the short case, then the long one, which is interrupted once it has begun.
void expect_earlier_results_to_stay(const std::string& short_case, const std::string& long_case,
                                    const std::string& file) {
  const TemporaryCase directory(short_case);
  const std::string place = directory.path().string();
  ASSERT_EQ(run_external({PFDM_PROGRAM, "run", place}).status, 0);
  const std::string earlier = content_of(directory.results() / file);
  directory.write("case.toml", long_case);
  const ProgramEnd end = interrupted("run " + place, "INT", directory.results() / ".new.partial/run.log", 1);
  EXPECT_EQ(end.status, 130) << end.err;
  EXPECT_EQ(end.err,
            "pfdm: interrupted; earlier results are unchanged, and the same command starts the run from "
            "the beginning\n");
  EXPECT_EQ(content_of(directory.results() / file), earlier);
}

TEST(InterruptedRun, OfAMaterialPointSaysThatItStartsAgain) {
  expect_earlier_results_to_stay(tension_case(), replaced(tension_case(), "repeat = 2", "repeat = 20000"),
                                 "history.csv");
}

TEST(InterruptedRun, OfAMassOnASampleSaysThatItStartsAgain) {
  expect_earlier_results_to_stay(shaken_for("20 s"), shaken_for("4000 s"), "up.csv");
}

INSTANTIATE_TEST_SUITE_P(Program, Interruption, testing::Values(std::pair("INT", 130), std::pair("TERM", 143)),
                         [](const auto& row) { return std::string(row.param.first); });

}  // namespace
}  // namespace pfdm::this_file
