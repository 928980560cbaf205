// The command line: what was meant by words that it does not know, help, completion, new cases.

#include "cases/program/commands.h"
#include "cases/program/kinds.h"
#include "cases/program/listing.h"
#include "cases/program/session/terminal/external_program.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path shipped = PFDM_CASES_DIR;

void expect_wrong(const std::vector<std::string>& arguments, const std::string& message) {
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr(message));
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
}

TEST(Commands, NameWhatWasMeant) {
  const std::string bar = (shipped / "bar_at1").string();
  expect_wrong({"runn", bar}, "unknown command \"runn\"; did you mean \"run\"?");
  expect_wrong({"help", "sweeep"}, "unknown command \"sweeep\"; did you mean \"sweep\"?");
  expect_wrong({"run", bar, "--thread", "2"}, "run has no option \"--thread\"; did you mean \"--threads\"?");
  expect_wrong({"run", "--thread=2", bar}, "run has no option \"--thread\"; did you mean \"--threads\"?");
  expect_wrong({"check", bar, "--restart"}, "check has no option \"--restart\"");
  expect_wrong({"--versoin"}, "pfdm has no option \"--versoin\"; did you mean \"--version\"?");
  expect_wrong({"--quiet", "run", bar}, "--quiet must follow the command");
  expect_wrong({"run", bar, "2"}, "run: unexpected argument \"2\"");
  expect_wrong({"run"}, "run: CASE is required; see pfdm help run");
  expect_wrong({}, "a command is required, as in: pfdm run cases/glass_bead_quick");
}

TEST(Commands, NameTheNearestCase) {
  const std::string near = nearest_case("glass_bead_quick", shipped).value();
  EXPECT_TRUE(fs::equivalent(near, shipped / "glass_bead_quick"));
  expect_wrong({"run", (shipped / "glass_bead_quik").string()},
               fmt::format("there is no such case directory; did you mean \"{}\"?", near));
  expect_wrong({"check", "glass_bead_quick/"}, fmt::format("did you mean \"{}\"?", near));
  const TemporaryCase directory(bar_case());
  EXPECT_TRUE(fs::equivalent(nearest_case(directory.path().string() + "x", shipped).value(), directory.path()));
  expect_wrong({"check", "no/such/case"}, "there is no such case directory\n");
}

TEST(Commands, HelpIsThatOfTheOption) {
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help", ""}).out, run({"--help"}).out);
  for (const CommandWords& command : command_words()) {
    const Outcome help = run({"help", command.name}), option = run({command.name, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, testing::StartsWith(option.out));
    EXPECT_THAT(help.out, HasSubstr("Exit status: 0 done; 1 the computation failed; 2 the input is wrong"));
    EXPECT_THAT(help.out, HasSubstr(command.description));
    EXPECT_THAT(run({"help"}).out, HasSubstr(command.name));
  }
}

TEST(Commands, HelpNamesTablesThatAreCalledAsOne) {
  EXPECT_THAT(run({"help", "mesh"}).out,
              testing::EndsWith("\n[mesh] is also a table of case.toml, with a dot: pfdm help \"mesh.\"\n"));
  EXPECT_EQ(run({"help", "run"}).out, run({"run", "--help"}).out);
  EXPECT_THAT(run({"help", "mesh."}).out, HasSubstr("in         mesh (fracture)"));
  const std::string temperature = run({"help", "temperature"}).out;  // a key of plates alone has the name
  EXPECT_THAT(temperature, testing::StartsWith("keys of fracture cases that tell of it:\n"));
  EXPECT_LT(temperature.find("loads.temperature_change (fracture)"), temperature.find("cooling[].temperature (plate)"));
  EXPECT_THAT(run({"help", "finite strain"}).out, testing::StartsWith("guide: cases/guides/finite_strain.md\n"));
}

TEST(Commands, KnowAllKindsByName) {
  std::vector<std::string_view> names;
  for (const CaseKind& kind : case_kinds()) names.push_back(kind.name);
  EXPECT_TRUE(std::ranges::equal(names, all_kind_names));
}

TEST(Commands, SayWhichTableIsMissing) {
  const TemporaryCase directory(bar_case());
  expect_wrong({"fit", directory.path().string()}, "the case has no [fit] table; it needs [[fit.parameters]]");
  expect_wrong({"fit", directory.path().string()}, "cases/bar_fit has one");
  expect_wrong({"sweep", directory.path().string()}, "the case has no [sweep] table; it needs a method and");
  expect_wrong({"fit", (shipped / "endochronic_uniaxial").string()}, "cases/endochronic_calibration has one");
  const TemporaryCase bulk(
      "kind = \"viscoelastic\"\ntitle = \"x\"\nmaterial = { young_modulus = \"1 MPa\", poisson_ratio = 0.4 }\n"
      "frequency_sweep = { from = \"1 Hz\", to = \"2 Hz\" }\n");
  expect_wrong({"fit", bulk.path().string()}, "cases/prony_calibration has one");
  EXPECT_TRUE(fs::exists(shipped / "bar_fit") && fs::exists(shipped / "glass_bead_radius"));
}

/// What bash would offer for these words, of which the last is not complete; in a folder with the case directories.
std::string completed(const fs::path& folder, const std::vector<std::string>& words) {
  std::string quoted;
  for (const std::string& word : words) quoted += fmt::format(" '{}'", word);
  const ProgramEnd end = run_external({"bash", "-c",
                                       fmt::format("cd {} && source <({} completion bash) && COMP_WORDS=({}) && "
                                                   "COMP_CWORD={} && _pfdm && printf '%s ' \"${{COMPREPLY[@]}}\"",
                                                   folder.string(), PFDM_PROGRAM, quoted, words.size() - 1)});
  EXPECT_EQ(end.err, "");
  return end.out;
}

TEST(Completion, KnowsEveryCommandAndOption) {
  for (const CommandWords& command : command_words()) {
    EXPECT_THAT(completed("/", {"pfdm", command.name}), HasSubstr(command.name));
    const std::string options = completed("/", {"pfdm", command.name, "-"});
    for (const CommandWords::Option& option : command.options) EXPECT_THAT(options, HasSubstr(option.name));
  }
  EXPECT_EQ(completed("/", {"pfdm", "run", "x", "--re"}), "--restart ");
  EXPECT_EQ(completed("/", {"pfdm", "sw"}), "sweep ");
  EXPECT_EQ(completed("/", {"pfdm", "completion", "z"}), "zsh ");
  EXPECT_EQ(completed("/", {"pfdm", "help", "young"}), "young_modulus ");
  EXPECT_EQ(completed("/", {"pfdm", "help", "swe"}), "sweep ");
  EXPECT_EQ(completed("/", {"pfdm", "cohesive", "x", "--export", "ab"}), "abaqus ");
  EXPECT_EQ(completed("/", {"pfdm", "cohesive", "x", "--units", "mm-k"}), "mm-kN-ms ");
  EXPECT_EQ(completed("/", {"pfdm", "run", "x", "--threads", ""}), " ");
}

TEST(Completion, KnowsCaseDirectories) {
  const TemporaryCase directory(bar_case());
  fs::create_directories(directory.path() / "cases/one");
  fs::create_directories(directory.path() / "cases/other two");
  fs::create_directories(directory.path() / "plain/deep");
  directory.write("cases/one/case.toml", bar_case());
  directory.write("cases/other two/case.toml", bar_case());
  EXPECT_EQ(completed(directory.path(), {"pfdm", "run", ""}), "cases ");
  EXPECT_EQ(completed(directory.path(), {"pfdm", "run", "cases/o"}), "cases/one cases/other two ");
  EXPECT_EQ(completed(directory.path(), {"pfdm", "init", "new", "--like", "cases/on"}), "cases/one ");
  EXPECT_EQ(completed(directory.path(), {"pfdm", "run", "pl"}), "plain ");
}

TEST(Completion, IsForShellsItKnows) { expect_wrong({"completion", "fish"}, "none for \"fish\""); }

TEST(Init, MakesACaseThatChecksLikeTheOld) {
  const TemporaryCase directory(bar_case());
  for (const auto& entry : fs::directory_iterator(shipped)) {
    if (!fs::exists(entry.path() / "case.toml")) continue;
    const std::string name = entry.path().filename().string();
    const fs::path made = directory.path() / name;
    const Outcome outcome = run({"init", made.string(), "--like", name});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("then: pfdm check " + made.string()));
    EXPECT_THAT(content_of(made / "case.toml"),
                HasSubstr("title = \"begun as a copy of " + name + "\"  # edit this title"));
    EXPECT_THAT(content_of(made / "case.toml"), Not(HasSubstr("\"../")));
    EXPECT_THAT(content_of(made / "README.md"), HasSubstr("`" + name + "`"));
    EXPECT_FALSE(fs::exists(made / "results"));
    // Files that [experiment] and [fit] name are read here.
    EXPECT_EQ(run({"fit", made.string(), "--output", "/dev/null/no"}).err.find("there is no file"), std::string::npos);
  }
}

TEST(Init, TakesDataFromBesideTheCase) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"init", (directory.path() / "new").string(), "--like", (shipped / "l_panel_fit").string()}).status, 0);
  EXPECT_EQ(content_of(directory.path() / "new/data/winkler_series_A.csv"),
            content_of(shipped / "l_panel/data/winkler_series_A.csv"));
  EXPECT_EQ(run({"check", (directory.path() / "new").string()}).status, 0);
}

// The record of another body is no test of the new one; a fit cannot do without one.
TEST(Init, LeavesTheRecordOutWhereNoFitNeedsIt) {
  const TemporaryCase directory(bar_case());
  const fs::path panel = directory.path() / "panel", bead = directory.path() / "bead";
  const Outcome without = run({"init", panel.string(), "--like", "l_panel"});
  EXPECT_THAT(without.out, HasSubstr("like l_panel, without its [experiment]: case.toml, README.md\n"));
  EXPECT_THAT(without.out, HasSubstr("(a record of your own goes into [experiment]: pfdm help experiment)"));
  EXPECT_THAT(content_of(panel / "case.toml"), Not(HasSubstr("experiment")));
  EXPECT_EQ(run({"check", panel.string()}).status, 0);
  EXPECT_THAT(run({"init", bead.string(), "--like", "glass_bead_quick"}).out,
              HasSubstr("edit case.toml, also [experiment], whose record is of glass_bead_quick, then: "));
  EXPECT_TRUE(fs::exists(bead / "data/synthetic_debonding.csv"));
}

TEST(Init, TellsOfARecordThatStandsInBraces) {
  const TemporaryCase directory(
      "experiment.specimens = [{ name = \"a\", csv = \"a.csv\", displacement = { column = "
      "\"u_m\", unit = \"m\" }, force = { column = \"F_N\", unit = \"N\" } }]\n"
      "experiment.stiffness_between = [\"0 um\", \"6 um\"]\n" +
      bar_case());
  directory.write("a.csv", "u_m,F_N\n0,0\n5e-6,5\n");
  const fs::path made = directory.path() / "made";
  EXPECT_THAT(run({"init", made.string(), "--like", directory.path().string()}).out,
              HasSubstr("edit case.toml, also [experiment], whose record is of "));
  EXPECT_TRUE(fs::exists(made / "a.csv"));
}

TEST(Init, RefusesWhatIsThere) {
  const TemporaryCase directory(bar_case());
  const std::string text = content_of(directory.path() / "case.toml");
  expect_wrong({"init", directory.path().string(), "--like", "bar_at1"}, "the directory is not empty");
  expect_wrong({"init", (directory.path() / "case.toml").string(), "--like", "bar_at1"}, "this is a file");
  expect_wrong({"init", (directory.path() / "new").string(), "--like", "bar_at9"}, "did you mean");
  EXPECT_EQ(content_of(directory.path() / "case.toml"), text);
  EXPECT_FALSE(fs::exists(directory.path() / "new"));
}

TEST(Init, ListsTheCasesToChooseFrom) {
  const Outcome outcome = run({"init", "new_case_of_a_test"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.out, HasSubstr("glass_bead_quick"));
  EXPECT_THAT(outcome.err, HasSubstr("pfdm init my_case --like glass_bead_quick"));
  EXPECT_FALSE(fs::exists("new_case_of_a_test"));
}

}  // namespace
}  // namespace pfdm::this_file
