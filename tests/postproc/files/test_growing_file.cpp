#include "physics/error.h"
#include "postproc/files/growing_file.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

ino_t inode(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

const auto not_asked = []() -> std::string {
  ADD_FAILURE() << "written anew";
  return {};
};

TEST(GrowingFile, grows_where_it_is) {
  const TemporaryFolder folder;
  GrowingFile file(folder / "table", "a\n");
  const ino_t before = inode(folder / "table");
  file.append("b\nc\n", not_asked);
  file.append("", not_asked);
  file.append("d\n", not_asked);
  EXPECT_EQ(content_of(folder / "table"), "a\nb\nc\nd\n");
  EXPECT_EQ(inode(folder / "table"), before);
}

TEST(GrowingFile, keeps_its_foot_at_the_end) {
  const TemporaryFolder folder;
  GrowingFile file(folder / "list", "<\n", ">>>>\n");
  for (const char* line : {"a longer line\n", "b\n", ""}) file.append(line, not_asked);
  EXPECT_EQ(content_of(folder / "list"), "<\na longer line\nb\n>>>>\n");
}

TEST(GrowingFile, is_written_anew_where_it_is_not_as_it_was_left) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "table";
  GrowingFile file(path, "a\n", "z\n");
  const auto whole = [] { return std::string("whole\n"); };
  const auto expect_anew = [&](const char* how) {
    file.append("b\n", whole);
    EXPECT_EQ(content_of(path), "whole\nz\n") << how;
  };
  std::filesystem::remove(path);
  expect_anew("removed");
  put(path, "whole\nz\n and more");
  expect_anew("extended");
  put(path, "w");
  expect_anew("cut");
  std::filesystem::create_hard_link(path, folder / "kept");
  expect_anew("with a second name");
  EXPECT_EQ(content_of(folder / "kept"), "whole\nz\n");
  std::filesystem::remove(path);
  std::filesystem::create_symlink(folder / "kept", path);
  expect_anew("a link");
  EXPECT_FALSE(std::filesystem::is_symlink(path));
  EXPECT_EQ(content_of(folder / "kept"), "whole\nz\n");
}

TEST(GrowingFile, holds_what_it_held_where_there_is_no_room) {
  const TemporaryFolder folder;
  GrowingFile file(folder / "table", "a\n", "end\n");
  const std::string line(50, 'b');
  {
    const FileSizeLimit limit(20);
    EXPECT_THAT(message_of<ComputationError>([&] { file.append(line + "\n", not_asked); }), HasSubstr("table"));
  }
  EXPECT_EQ(content_of(folder / "table"), "a\nend\n");
  file.append(line + "\n", not_asked);
  EXPECT_EQ(content_of(folder / "table"), "a\n" + line + "\nend\n");
}

}  // namespace
}  // namespace pfdm::test::this_file
