// The case file among the results of a run: what ran, and what was changed since.

#include "cases/program/input/case_files/kept_case.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(KeptCase, NamesTheKeysThatWereChanged) {
  const TemporaryCase directory(bar_case());
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place, "--max-steps", "3"}).status, 0);
  directory.write("case.toml",
                  replaced(bar_case(), "\"30 GPa\"", "\"31 GPa\"") + "[solver]\nmaximum_iterations = 900\n");
  const std::string change = "changed since: materials.concrete.young_modulus = \"31 GPa\" (was \"30 GPa\")\n";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", place, "--restart"}, std::vector<std::string>{"report", place}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(change)) << command.front();
  }
  const Outcome anew = run({"run", place, "--max-steps", "3"});
  EXPECT_THAT(anew.out, HasSubstr("belong to different input: "));
  EXPECT_THAT(anew.out, HasSubstr(change));
  EXPECT_EQ(run({"run", place, "--restart"}).status, 0);
}

TEST(KeptCase, IsReportedWhateverBecameOfTheCase) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  directory.write("case.toml", replaced(bar_case(), "\"30 GPa\"", "\"31 GPa\""));
  EXPECT_EQ(run({"report", directory.path().string()}).status, 2);
  const Outcome report = run({"report", directory.results().string()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(fs::exists(directory.results() / "report/report.pdf"));
  EXPECT_EQ(case_name(open_case(directory.results())), directory.path().filename().string());
}

// Its paths are seen from the results, and from the case again where it is read.
TEST(KeptCase, FindsItsFiles) {
  const TemporaryCase directory(bar_case() + measured_specimen());
  fs::create_directory(directory.path() / "data");
  directory.write("data/one.csv", "u,f\n0,0\n5,0.2\n10,0.4\n");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  EXPECT_THAT(content_of(directory.results() / "case.toml"), HasSubstr("csv = \"../data/one.csv\""));
  EXPECT_THAT(open_case(directory.results()).text, HasSubstr("csv = \"data/one.csv\""));
  EXPECT_EQ(run({"compare", directory.results().string()}).status, 0);
  // Started again from there it is the same run.
  EXPECT_THAT(run({"run", directory.results().string(), "--restart"}).out, HasSubstr("is complete already"));
}

// A copy of the file, and what init makes of it, is a case like any other.
TEST(KeptCase, IsACaseLikeAnyOtherElsewhere) {
  const TemporaryCase directory(bar_case()), copy(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  copy.write("case.toml", content_of(directory.results() / "case.toml"));
  ASSERT_EQ(run({"run", copy.path().string(), "--max-steps", "1"}).status, 0);
  EXPECT_TRUE(fs::exists(copy.results() / "summary.json"));
  EXPECT_EQ(case_name(open_case(copy.path())), copy.path().filename().string());
  const std::string made = (copy.path() / "new").string();
  ASSERT_EQ(run({"init", made, "--like", directory.results().string()}).status, 0);
  EXPECT_EQ(case_name(open_case(made)), "new");
}

TEST(KeptCase, LeavesACaseAloneWhoseFolderTakesTheResults) {
  const TemporaryCase directory(bar_case());
  const std::vector<std::string> words{"run", directory.path().string(), "--output", directory.path().string()};
  directory.write("force_displacement.csv", "measured");
  EXPECT_EQ(run(words).status, 2);
  EXPECT_EQ(content_of(directory.path() / "force_displacement.csv"), "measured");
  directory.write(".pfdm", "");
  ASSERT_EQ(run(words).status, 0);
  EXPECT_EQ(content_of(directory.path() / "case.toml"), bar_case());
}

TEST(KeptCase, OfAFittedCaseHasAFolderAmongTheResults) {
  const TemporaryCase directory(bar_case());
  fs::create_directory(directory.results());
  directory.write("results/case.fitted.toml", bar_case());
  const std::string fitted = (directory.results() / "case.fitted.toml").string();
  ASSERT_EQ(run({"run", fitted, "--max-steps", "2"}).status, 0);
  EXPECT_TRUE(fs::exists(directory.results() / "fitted/summary.json"));
  EXPECT_FALSE(fs::exists(directory.results() / "results"));
  EXPECT_EQ(run({"report", fitted}).status, 0);
}

TEST(KeptCase, IsOneOfARunInASweep) {
  const TemporaryCase directory(bar_case() + R"(
[sweep]
method = "grid"
[[sweep.parameters]]
key = "materials.concrete.young_modulus"
values = ["30 GPa", "40 GPa"]
)");
  const std::string place = directory.path().string();
  const Outcome check = run({"check", place});
  EXPECT_THAT(check.out, HasSubstr("pfdm sweep would make 2 runs:\n  run 1: concrete.young_modulus = 30 GPa\n"));
  const Outcome outcome = run({"sweep", place});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const fs::path by_value = directory.results() / "runs_by_value/concrete.young_modulus=40GPa";
  ASSERT_TRUE(fs::exists(by_value / "summary.json"));
  EXPECT_THAT(content_of(by_value / "case.toml"), HasSubstr("40 GPa"));
  const Outcome report = run({"report", by_value.string()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_TRUE(fs::exists(by_value / "report/report.pdf"));
  EXPECT_EQ(run({"report", place}).status, 0);
  EXPECT_TRUE(fs::exists(directory.results() / "report/report.pdf"));
  ASSERT_EQ(run({"run", place}).status, 0);
  EXPECT_EQ(run({"report", place}).status, 0);
  EXPECT_TRUE(fs::exists(directory.results() / "report/sweep/report.pdf"));
  EXPECT_TRUE(fs::exists(directory.results() / "report/report.pdf"));
}

TEST(KeptCase, OfAnotherKindNamesChangesToo) {
  const TemporaryCase directory(soft_sample() + R"([[test]]
name = "sine"
excitation = { type = "random", density = "0.001 g0^2/Hz", from = "10 Hz", to = "100 Hz", duration = "2 s", seed = 1 }
)");
  const std::string place = directory.path().string(), text = content_of(directory.path() / "case.toml");
  ASSERT_EQ(run({"run", place}).status, 0) << run({"run", place}).err;
  directory.write("case.toml", replaced(text, "1.12 kg", "1.13 kg"));
  EXPECT_THAT(run({"run", place}).out, HasSubstr("changed since: model.mass = \"1.13 kg\" (was \"1.12 kg\")"));
}

}  // namespace
}  // namespace pfdm::this_file
