#include "physics/error.h"
#include "postproc/folder_lock.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace pfdm::test
