#include "physics/error.h"
#include "physics/system/machine_limits.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

class ControlGroups : public testing::Test {
 protected:
  void put(const std::string& file, const std::string& content) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << content;
  }
  MachineLimits limits() const { return machine_limits(root_.path(), root_ / "memberships"); }

 private:
  test::TemporaryFolder root_;
};

TEST_F(ControlGroups, ThatAreNotThereLimitNothing) {
  EXPECT_GE(limits().processors, 1);
  EXPECT_GT(limits().memory, 1e8);
  put("memberships", "0::/\n");
  put("memory.max", "max\n");
  put("cpu.max", "max 100000\n");
  EXPECT_EQ(limits().processors, machine_limits("none", "none").processors);
  EXPECT_EQ(limits().memory, machine_limits("none", "none").memory);
}

TEST_F(ControlGroups, OfVersion2LimitFromTheProcessUpwards) {
  put("memberships", "0::/batch/job\n");
  put("batch/memory.max", "300000000\n");
  put("batch/job/memory.max", "max\n");
  put("batch/job/cpu.max", "100000 100000\n");
  EXPECT_EQ(limits().memory, 3e8);
  EXPECT_EQ(limits().processors, 1);
  put("other/memory.max", "1000\n");
  EXPECT_EQ(limits().memory, 3e8);
}

TEST_F(ControlGroups, OfVersion1LimitToo) {
  put("memberships", "4:memory:/box\n3:cpu,cpuacct:/box\n");
  put("memory/box/memory.limit_in_bytes", "200000000\n");
  put("cpu/box/cpu.cfs_quota_us", "40000\n");
  put("cpu/box/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(limits().memory, 2e8);
  EXPECT_EQ(limits().processors, 1);
  put("cpu/box/cpu.cfs_quota_us", "-1\n");
  EXPECT_GE(limits().processors, 1);
}

TEST(Memory, ThatIsNotThereIsSaid) {
  const MachineLimits machine{.processors = 2, .memory = 4e9};
  require_memory(4e9, "the mesh", machine);
  try {
    require_memory(5e9, "the mesh", machine);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "the mesh would take about 5 GB of memory; there are 4 GB here");
  }
}

}  // namespace
}  // namespace pfdm::this_file
