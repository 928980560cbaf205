// What is in the results' folder is not lost: neither the steps of a run that is killed, nor earlier results before new
// ones can take their place.

#include "tests/cases/killed_run.h"
#include "tests/cases/temporary_case.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

using Files = std::map<std::string, std::string>;

/// All files of a folder, but without the content of those that tell of times, and of frames, whose header tells how
/// many VTK has written before.
Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), folder);
    const bool varies = name == "run.log" || name == "summary.json" || name.extension() == ".vtu";
    files[name.string()] = varies ? "" : content_of(entry.path());
  }
  return files;
}

std::vector<std::string> names_of(const Files& files) {
  std::vector<std::string> names;
  for (const auto& [name, content] : files) names.push_back(name);
  return names;
}

void expect_same(const Files& found, const Files& due, const std::string& when) {
  ASSERT_EQ(names_of(found), names_of(due)) << when;
  for (const auto& [name, content] : due) EXPECT_TRUE(found.at(name) == content) << name << " " << when;
}

std::string status_in(const fs::path& results) {
  return nlohmann::json::parse(content_of(results / "summary.json")).at("status");
}

/// Three steps of a bar that is damaged from the beginning, with all that is recorded at each step.
std::string recorded_bar() {
  std::string text = replaced(bar_case(), "frames_at = [\"0.006 mm\"]", "frames_every = 1");
  text = replaced(text, "[loading]", "[initial]\ndamage = 0.3\nregions = [\"weak\"]\n[loading]\nend = 0.3");
  return text + crack_plane() + R"([[output.energy_release_rate]]
name = "middle"
point = ["10 mm", "0.5 mm", "0.5 mm"]
direction = [0, 1, 0]
inner = "0.1 mm"
outer = "0.4 mm"
)";
}

std::string other_bar() { return replaced(recorded_bar(), "\"30 GPa\"", "\"31 GPa\""); }

std::vector<std::string> run_of(const TemporaryCase& directory, const fs::path& results) {
  return {"run", directory.path().string(), "--output", results.string(), "--threads", "1"};
}

std::vector<std::string> restart_of(const TemporaryCase& directory, const fs::path& results) {
  auto arguments = run_of(directory, results);
  arguments.emplace_back("--restart");
  return arguments;
}

TEST(KilledRun, GoesOnToTheSameResultsWhereverItWasKilled) {
  const TemporaryCase directory(recorded_bar());
  ASSERT_EQ(run(run_of(directory, directory.path() / "whole")).status, 0);
  const Files whole = files_in(directory.path() / "whole");
  ASSERT_TRUE(whole.contains("cohesive.json"));
  const fs::path broken = directory.path() / "broken";
  int kills = 0;
  for (; run_killed_after(kills, run_of(directory, broken)); ++kills) {
    const Outcome outcome = run(restart_of(directory, broken));
    ASSERT_EQ(outcome.status, 0) << outcome.err << "after " << kills;
    expect_same(files_in(broken), whole, "after " + std::to_string(kills));
    EXPECT_EQ(status_in(broken), "complete") << kills;
    fs::remove_all(broken);
  }
  EXPECT_GT(kills, 30);
}

TEST(KilledRun, LeavesEarlierResultsOrOnesThatCanBeGoneOnWith) {
  const TemporaryCase directory(other_bar());
  const fs::path earlier = directory.path() / "earlier";
  ASSERT_EQ(run(run_of(directory, earlier)).status, 0);
  const Files old = files_in(earlier);
  directory.write("case.toml", recorded_bar());
  ASSERT_EQ(run(run_of(directory, directory.path() / "whole")).status, 0);
  const Files whole = files_in(directory.path() / "whole");
  const fs::path results = directory.path() / "results";
  int kept = 0, kills = 0;
  for (;; ++kills) {
    fs::remove_all(results);
    fs::copy(earlier, results, fs::copy_options::recursive);
    if (!run_killed_after(kills, run_of(directory, results))) break;
    const std::string when = "after " + std::to_string(kills);
    if (content_of(results / "checkpoint.bin") == old.at("checkpoint.bin")) {
      ++kept;
      for (const char* file : {"force_displacement.csv", "fields.pvd", "energy_release_rate.csv"})
        EXPECT_TRUE(content_of(results / file) == old.at(file)) << file << " " << when;
      EXPECT_EQ(run(restart_of(directory, results)).status, 2) << when;
      continue;
    }
    ASSERT_EQ(run(restart_of(directory, results)).status, 0) << when;
    expect_same(files_in(results), whole, when);
  }
  EXPECT_GT(kept, 15);  // all writes of the start and the first step
  EXPECT_GT(kills, kept + 15);
  expect_same(files_in(results), whole, "at the end");
}

/// Results of a run, and what must not happen to them.
class EarlierResults : public testing::Test {
 protected:
  EarlierResults() : directory(recorded_bar()) {
    if (run({"run", place(), "--quiet"}).status != 0) throw std::logic_error("the bar does not run");
    if (run({"report", place(), "--quiet"}).status != 0) throw std::logic_error("no report");
    before = files_in(directory.results());
    summary = content_of(directory.results() / "summary.json");
    log = content_of(directory.results() / "run.log");
  }
  std::string place() const { return directory.path().string(); }
  void expect_untouched(const std::string& when) const {
    expect_same(files_in(directory.results()), before, when);
    EXPECT_EQ(content_of(directory.results() / "summary.json"), summary) << when;
    EXPECT_EQ(content_of(directory.results() / "run.log"), log) << when;
    EXPECT_FALSE(fs::exists(directory.results() / ".new.partial")) << when;
  }
  TemporaryCase directory;
  Files before;
  std::string summary, log;
};

TEST_F(EarlierResults, StayWhereAnExpressionHasNoValue) {
  directory.write("case.toml", replaced(recorded_bar(), "\"0.015 mm\"", "{ expr = \"15*t/(t-t)\", unit = \"um\" }"));
  for (const char* command : {"check", "run"}) {
    const Outcome outcome = run({command, place()});
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr("case.toml:34: [boundary] displacement[0]: the expression")) << command;
  }
  expect_untouched("after an expression without a value");
}

TEST_F(EarlierResults, StayWhereTheFirstStepDoesNotConverge) {
  directory.write("case.toml",
                  replaced(recorded_bar(), "initial_increment", "minimum_increment = 0.1\ninitial_increment") +
                      "[solver]\nmaximum_iterations = 1\n");
  const Outcome outcome = run({"run", place()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("the earlier results in " + directory.results().string() + " are kept"));
  expect_untouched("after a failed first step");
}

TEST_F(EarlierResults, StayWhereTheDiskIsFull) {
  for (const rlim_t bytes : {200, 1000, 5000}) {
    const test::FileSizeLimit limit(bytes);
    EXPECT_EQ(run({"run", place(), "--quiet"}).status, 1);
    expect_untouched("with room for " + std::to_string(bytes) + " bytes a file");
  }
}

TEST_F(EarlierResults, AreReplacedWithAWordAndWithAllThatWasMadeOfThem) {
  directory.write("results/comparison.json", "of the earlier run");
  const Outcome outcome = run({"run", place(), "--max-steps", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the results in " + directory.results().string() +
                                     " are complete: this run starts anew and replaces them once it has its own; with "
                                     "--restart they would be kept"));
  for (const char* stale : {"report", "comparison.json", ".new.partial"})
    EXPECT_FALSE(fs::exists(directory.results() / stale)) << stale;
  EXPECT_FALSE(fs::exists(directory.results() / "fields" / "step_000003.vtu"));
  EXPECT_THAT(content_of(directory.results() / "run.log"), HasSubstr("starts anew"));
}

TEST_F(EarlierResults, LoseWhatWasMadeOfThemWhenARunGoesOn) {
  ASSERT_EQ(run({"run", place(), "--max-steps", "1"}).status, 0);
  ASSERT_EQ(run({"report", place()}).status, 0);
  const Outcome outcome = run({"run", place(), "--restart"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(directory.results() / "report"));
  EXPECT_EQ(status_in(directory.results()), "complete");
}

TEST_F(EarlierResults, AreOfOtherInputAndNotGoneOnWith) {
  directory.write("case.toml", other_bar());
  const Outcome refused = run({"run", place(), "--restart"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("without --restart the run starts anew and replaces it"));
  expect_untouched("after a refused restart");
  const Outcome anew = run({"run", place()});
  EXPECT_THAT(anew.out, HasSubstr("belong to different input"));
  EXPECT_THAT(anew.out, Not(HasSubstr("--restart would")));
}

/// The summary is a link to a file that is not this program's.
TEST_F(EarlierResults, ThatAreLinksAreReplacedAndTheirTargetsAreNot) {
  for (const char* file : {"run.log", "force_displacement.csv", "summary.json"}) {
    directory.write("mine.txt", "mine");
    fs::remove(directory.results() / file);
    fs::create_symlink(directory.path() / "mine.txt", directory.results() / file);
    ASSERT_EQ(run({"run", place(), "--quiet"}).status, 0) << file;
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(directory.results() / file))) << file;
    EXPECT_EQ(content_of(directory.path() / "mine.txt"), "mine") << file;
  }
}

TEST(Results, GoToAnotherFolderWhereTheirOwnCannotBeMade) {
  const TemporaryCase directory(bar_case());
  directory.write("results", "a file");
  for (const char* command : {"run", "mesh"}) {
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_THAT(outcome.err, HasSubstr("cannot make the folder " + directory.results().string())) << command;
    EXPECT_THAT(outcome.err, HasSubstr("--output DIR")) << command;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(run({"run", directory.path().string(), "--output", (directory.path() / "other").string()}).status, 0);
}

}  // namespace
}  // namespace pfdm::this_file
