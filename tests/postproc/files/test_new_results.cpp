#include "postproc/files/atomic_file.h"
#include "postproc/files/new_results.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>

namespace pfdm::test::this_file {
namespace {

namespace fs = std::filesystem;

void put_some(const fs::path& results, const std::string& content) {
  make_folder(results / "steps" / "one");
  put(results / "steps" / "one" / "a.txt", content);
  put(results / "last.txt", content);
}

TEST(NewResults, wait_beside_the_earlier_ones_and_take_their_place) {
  const TemporaryFolder folder;
  put_some(folder.path(), "old");
  put(folder / "steps" / "mine.txt", "mine");
  NewResults results(folder.path(), true);
  EXPECT_TRUE(results.wait());
  put_some(results.folder(), "new");
  EXPECT_EQ(content_of(folder / "last.txt"), "old");
  results.take_place([&] { fs::remove(folder / "last.txt"); }, "last.txt");
  EXPECT_FALSE(results.wait());
  EXPECT_EQ(results.folder(), folder.path());
  EXPECT_EQ(content_of(folder / "last.txt"), "new");
  EXPECT_EQ(content_of(folder / "steps" / "one" / "a.txt"), "new");
  EXPECT_EQ(content_of(folder / "steps" / "mine.txt"), "mine");
  EXPECT_EQ(folder.n_entries(), 2u);
}

TEST(NewResults, come_to_nothing_where_they_do_not_take_place) {
  const TemporaryFolder folder;
  put_some(folder.path(), "old");
  put_some(folder / ".new.partial", "of a killed run");
  {
    const NewResults results(folder.path(), true);
    EXPECT_TRUE(fs::is_empty(results.folder()));
    put_some(results.folder(), "new");
  }
  EXPECT_EQ(content_of(folder / "last.txt"), "old");
  EXPECT_EQ(folder.n_entries(), 2u);
}

TEST(NewResults, go_where_they_belong_where_nothing_is) {
  const TemporaryFolder folder;
  NewResults results(folder.path(), false);
  EXPECT_EQ(results.folder(), folder.path());
  put_some(results.folder(), "new");
  results.take_place([] { FAIL() << "nothing to remove"; }, "last.txt");
  EXPECT_EQ(content_of(folder / "last.txt"), "new");
}

}  // namespace
}  // namespace pfdm::test::this_file
