// Every case that ships can be read; meshes are made by the cases' own runs.

#include "cases/program/case_file.h"
#include "cases/program/kinds.h"

#include <gtest/gtest.h>

namespace pfdm {
namespace {

TEST(ShippedCases, CanBeRead) {
  int n_cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PFDM_CASES_DIR)) {
    if (!std::filesystem::exists(entry.path() / "case.toml")) continue;
    ++n_cases;
    EXPECT_NO_THROW(EXPECT_FALSE(read_case(open_case(entry.path())).title.empty())) << entry.path();
    EXPECT_TRUE(std::filesystem::exists(entry.path() / "README.md")) << entry.path();
  }
  EXPECT_GT(n_cases, 0);
}

}  // namespace
}  // namespace pfdm
