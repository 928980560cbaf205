// pfdm sweep --slurm, on a Slurm of the test's own: controller, node and munge, started and stopped by it. Skipped
// where Slurm is not installed (Debian: slurm-wlm).

#include "cases/program/session/terminal/external_program.h"
#include "cases/program/studies/runs/slurm.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/own_slurm.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string sweep_of_bar(const std::string& slurm) {
  return bar_case() +
         "\n[sweep]\nmethod = \"list\"\n[[sweep.parameters]]\nkey = \"materials.concrete.young_modulus\"\n" +
         "values = [\"30 GPa\", \"35 GPa\", \"40 GPa\"]\n\n[sweep.slurm]\n" + slurm + "\n";
}

/// Tasks wait until the test lets them go.
const std::string held = "time = \"10 min\"\ncpus_per_task = 2\nmemory = \"1 MB\"\npartition = \"all\"\n" +
                         std::string("lines = [\"while ! test -e ../../go; do sleep 0.1; done\"]");

/// The program itself: what runs the test is not what a task could start.
ProgramEnd pfdm_sweep(const TemporaryCase& directory, std::vector<std::string> more) {
  std::vector<std::string> words{PFDM_PROGRAM, "sweep", directory.path().string()};
  words.insert(words.end(), more.begin(), more.end());
  return run_external(words);
}

class SweepOnSlurm : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto program = OwnSlurm::missing_program())
      GTEST_SKIP() << "there is no " << *program << " here; Debian's package slurm-wlm has it";
    slurm_.emplace();
  }
  std::optional<OwnSlurm> slurm_;
};

TEST_F(SweepOnSlurm, MakesTheTableOfALocalOne) {
  const TemporaryCase directory(sweep_of_bar(held));
  ASSERT_EQ(pfdm_sweep(directory, {}).status, 0);
  const std::string local = content_of(directory.results() / "sweep.csv");
  const fs::path results = directory.path() / "results of 'all'";
  const std::vector<std::string> there{"--output", results.string()};
  const std::vector<std::string> handed{"--slurm", "--output", results.string()};

  const ProgramEnd first = pfdm_sweep(directory, handed);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("Slurm job 1: 3 runs submitted"));
  const ProgramEnd second = pfdm_sweep(directory, handed);
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_THAT(second.out, HasSubstr("Slurm job 1: 3 runs queued"));
  EXPECT_THAT(second.out, HasSubstr("Nothing was submitted"));
  ASSERT_TRUE(slurm_->wait_for_running(1)) << "two processors are there, each task asks for both";
  EXPECT_THAT(pfdm_sweep(directory, handed).out,
              HasSubstr("2 runs queued (Resources), 1 running; 3 runs are not complete"));
  const ProgramEnd here = pfdm_sweep(directory, there);
  EXPECT_EQ(here.status, 2);
  EXPECT_THAT(here.err, HasSubstr("wait for them, or stop them with scancel 1"));
  EXPECT_FALSE(fs::exists(results / "sweep.csv"));

  directory.write("case.toml", "this is changed while the tasks wait");
  directory.write("go", "");
  ASSERT_TRUE(slurm_->wait_for_jobs());
  EXPECT_THAT(content_of(results / "sweep" / "task_3.log"), HasSubstr("complete at step"));
  directory.write("case.toml", sweep_of_bar(held));
  const ProgramEnd last = pfdm_sweep(directory, handed);
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.out, HasSubstr("0 runs made, 3 reused"));
  EXPECT_EQ(content_of(results / "sweep.csv"), local);
}

TEST_F(SweepOnSlurm, SubmitsAgainWhatWasLost) {
  const TemporaryCase directory(sweep_of_bar(held));
  ASSERT_EQ(pfdm_sweep(directory, {"--slurm"}).status, 0);
  ASSERT_TRUE(slurm_->wait_for_running(1));
  ASSERT_EQ(run_external({"scancel", "1"}).status, 0);
  ASSERT_TRUE(slurm_->wait_for_jobs());

  directory.write("go", "");
  const ProgramEnd again = pfdm_sweep(directory, {"--slurm"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out + again.err,
              HasSubstr("young_modulus = 30 GPa ended without a result; the last line of its output: slurmstepd"));
  EXPECT_THAT(again.out, HasSubstr("3 runs submitted;"));
  ASSERT_TRUE(slurm_->wait_for_jobs());
  ASSERT_EQ(pfdm_sweep(directory, {"--slurm"}).status, 0);
  const std::string table = content_of(directory.results() / "sweep.csv");

  // As if killed: two runs are missing, one of them stopped on its way.
  auto runs = fs::directory_iterator(directory.results() / "runs");
  fs::remove_all(runs->path());
  fs::remove((++runs)->path() / "summary.json");
  fs::remove(directory.results() / "sweep.csv");
  const ProgramEnd rest = pfdm_sweep(directory, {"--slurm"});
  EXPECT_THAT(rest.out, HasSubstr("2 runs submitted"));
  ASSERT_TRUE(slurm_->wait_for_jobs());
  EXPECT_EQ(pfdm_sweep(directory, {}).status, 0) << "collects as well";
  EXPECT_EQ(content_of(directory.results() / "sweep.csv"), table);
}

TEST_F(SweepOnSlurm, PassesOnWhatSlurmObjectsTo) {
  const TemporaryCase directory(sweep_of_bar("partition = \"none\"\nlargest_array = 2"));
  const ProgramEnd refused = pfdm_sweep(directory, {"--slurm"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr("invalid partition"));
  directory.write("case.toml", sweep_of_bar("largest_array = 2"));
  const ProgramEnd in_two = pfdm_sweep(directory, {"--slurm"});
  EXPECT_THAT(in_two.out, HasSubstr("2 runs submitted, 1 left for the next job"));
  EXPECT_THAT(in_two.out + in_two.err, Not(HasSubstr("without a result")));
  ASSERT_TRUE(slurm_->wait_for_jobs());
  EXPECT_THAT(pfdm_sweep(directory, {"--slurm"}).out, HasSubstr("1 runs submitted"));
  ASSERT_TRUE(slurm_->wait_for_jobs());
  EXPECT_THAT(pfdm_sweep(directory, {"--slurm"}).out, HasSubstr("0 runs made, 3 reused"));
}

TEST(Slurm, IsMissedWithOneMessage) {
  const TemporaryCase directory(sweep_of_bar(""));
  const std::string path = getenv("PATH");
  setenv("PATH", directory.path().c_str(), 1);
  const Outcome outcome = run({"sweep", directory.path().string(), "--slurm"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("sbatch and squeue are not on the PATH"));
  EXPECT_FALSE(fs::exists(directory.results()));
}

TEST(Slurm, ReadsOptionsBeforeTheFirstCommand) {
  SlurmSettings settings;
  settings.time = 5401.0;
  settings.memory = "4G";
  settings.at_once = 10;
  settings.lines = {"module load openblas", "#SBATCH --account=glass"};
  EXPECT_EQ(array_script(settings, "a bead", 7, "true\n"),
            "#!/bin/bash\n#SBATCH --job-name=a_bead\n#SBATCH --array=1-7%10\n#SBATCH --output=task_%a.log\n"
            "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n#SBATCH --time=91\n#SBATCH --mem=4G\n"
            "#SBATCH --account=glass\nmodule load openblas\ntrue\n");
  EXPECT_EQ(quoted("a 'b' $c"), R"('a '\''b'\'' $c')");
}

TEST(Slurm, TaskRefusesARunThatIsNoLongerTheSame) {
  const TemporaryCase directory(sweep_of_bar(""));
  fs::create_directories(directory.results() / "sweep");
  directory.write("results/sweep/0123456789abcdef_1.toml", bar_case());
  const Outcome outcome = run({"sweep", directory.path().string(), "--output", directory.results().string(),
                               "--prepared", "0123456789abcdef_1"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("have changed since this run was prepared"));
}

}  // namespace
}  // namespace pfdm::this_file
