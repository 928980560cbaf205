#include "postproc/files/step_table.h"

#include "physics/error.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace pfdm::this_file {
namespace {

TEST(StepTable, GoesOnAfterAStep) {
  const test::TemporaryFolder folder;
  const auto path = folder / "steps.csv";
  {
    StepTable table(path, {"step", "G"}, std::nullopt);
    table.append({0.0, 0.1});
    table.append({1.0, std::numeric_limits<double>::quiet_NaN()});
    table.append({2.0, 1.0 / 3.0});
  }
  StepTable table(path, {"step", "G"}, 1);
  ASSERT_EQ(table.rows().size(), 2U);
  EXPECT_EQ(table.rows()[0][1], 0.1);
  EXPECT_TRUE(std::isnan(table.rows()[1][1]));
  table.append({2.0, 1.0 / 3.0});
  EXPECT_EQ(StepTable(path, {"step", "G"}, 5).rows()[2], (std::vector<double>{2.0, 1.0 / 3.0}));
  EXPECT_TRUE(StepTable(path, {"step", "G"}, std::nullopt).rows().empty());
  EXPECT_TRUE(StepTable(folder / "none.csv", {"step", "G"}, 3).rows().empty());
}

TEST(StepTable, RefusesWhatIsNoSuchTable) {
  const test::TemporaryFolder folder;
  const auto path = folder / "steps.csv";
  for (const auto& [content, message] : {std::pair("step,J\n0,1\n", "line 1"), std::pair("step,G\n0,1\n1\n", "line 3"),
                                         std::pair("step,G\n0,one\n", "line 2")}) {
    std::ofstream(path) << content;
    try {
      const StepTable table(path, {"step", "G"}, 9);
      ADD_FAILURE() << content;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(message));
    }
  }
}

}  // namespace
}  // namespace pfdm::this_file
