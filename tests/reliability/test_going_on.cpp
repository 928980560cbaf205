// What a run that failed leaves, and what a restart makes of it.

#include "postproc/fields/pvd.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

bool lists(const TemporaryCase& directory, const std::string& file) {
  return std::ranges::any_of(read_pvd(directory.results() / "fields.pvd"),
                             [&](const Frame& frame) { return frame.file == file; });
}

// A frame of the last state of a run that fails shows why; none is due there, so a run that goes on has none.
TEST(GoingOn, AfterAFailureLeavesTheFramesOfAnUnbrokenRun) {
  const std::string increment = "maximum_increment = 0.1";
  const std::string bar = replaced(bar_case(), increment, increment + "\nminimum_increment = 0.01");
  const TemporaryCase directory(bar + "\n[solver]\nmaximum_iterations = 3\n");
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place}).status, 1);
  const std::string last = read_pvd(directory.results() / "fields.pvd").back().file;
  ASSERT_TRUE(std::filesystem::exists(directory.results() / last));
  const Outcome outcome = run({"run", place, "--restart", "--set", "solver.maximum_iterations=5000"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(lists(directory, last));
  EXPECT_FALSE(std::filesystem::exists(directory.results() / last));
}

}  // namespace
}  // namespace pfdm::this_file
