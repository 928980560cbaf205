#include "physics/error.h"
#include "postproc/files/folder_lock.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace pfdm::test {
namespace {

using ::testing::HasSubstr;

TEST(FolderLock, lets_one_in_at_a_time) {
  const TemporaryFolder folder;
  const auto results = folder / "results";
  {
    const FolderLock first(results);
    EXPECT_THAT(message_of<InputError>([&] { FolderLock second(results); }), HasSubstr(results.string()));
    EXPECT_THAT(message_of<InputError>([&] { FolderLock second(results); }), HasSubstr("another run"));
  }
  EXPECT_NO_THROW(FolderLock third(results));
}

TEST(FolderLock, names_what_is_not_a_folder) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  EXPECT_THAT(message_of<ComputationError>([&] { FolderLock lock(folder / "file"); }),
              HasSubstr((folder / "file").string()));
}

TEST(FolderLock, says_where_else_results_may_go) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  EXPECT_THAT(message_of<ComputationError>([&] { FolderLock lock(folder / "file" / "results"); }),
              HasSubstr("Not a directory; --output DIR puts the results elsewhere"));
}

// Found out before a run has computed anything.
TEST(FolderLock, refuses_a_folder_that_cannot_be_written_to) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT(message_of<ComputationError>([&] { FolderLock lock(folder.path()); }),
              HasSubstr("Permission denied; --output DIR"));
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(FolderLock, removes_what_killed_runs_left) {
  const TemporaryFolder folder;
  put(folder / ".a.txt.17_0.partial", "half");
  const FolderLock lock(folder.path());
  EXPECT_EQ(folder.n_entries(), 0u);
}

}  // namespace
}  // namespace pfdm::test
