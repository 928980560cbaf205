#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "tests/postproc/temporary_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

TEST(AtomicFile, holds_what_was_written_and_leaves_nothing_else) {
  const TemporaryFolder folder;
  const std::string content("one\0two\n", 8);
  write_file(folder / "a.txt", "an earlier, longer content");
  write_file(folder / "a.txt", content);
  EXPECT_EQ(content_of(folder / "a.txt"), content);
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, removes_what_a_killed_run_left_behind) {
  const TemporaryFolder folder;
  put(folder / ".a.txt.17_0.partial", "half of something longer than the new content");
  put(folder / "..hidden.4194304_12.partial", "half of something");
  write_file(folder / "a.txt", "whole");
  remove_leftovers(folder.path());
  EXPECT_EQ(content_of(folder / "a.txt"), "whole");
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, leaves_partial_files_of_others_alone) {
  const TemporaryFolder folder;
  const char* others[] = {"b.partial",      ".X.partial",          ".a.txt.partial", ".17_0.partial",
                          ".a.17.partial",  ".a._0.partial",       ".a.17_.partial", ".a.17_0x.partial",
                          ".a17_0.partial", ".a.17_0.partial.bak", "..17_0.partial"};
  for (const char* name : others) put(folder / name, "somebody's file");
  remove_leftovers(folder.path());
  for (const char* name : others) EXPECT_EQ(content_of(folder / name), "somebody's file") << name;
}

// Links that somebody else laid where the temporary file would be.
TEST(AtomicFile, does_not_write_through_links) {
  const TemporaryFolder folder;
  put(folder / "mine", "mine");
  for (int attempt = 0; attempt < 2; ++attempt)
    std::filesystem::create_symlink(
        folder / "mine", folder / (".a.txt." + std::to_string(getpid()) + "_" + std::to_string(attempt) + ".partial"));
  std::filesystem::create_symlink(folder / "mine", folder / ".a.txt.partial");
  std::filesystem::create_symlink(folder / "mine", folder / "a.txt");
  write_file(folder / "a.txt", "whole");
  EXPECT_EQ(content_of(folder / "mine"), "mine");
  EXPECT_EQ(content_of(folder / "a.txt"), "whole");
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / "a.txt")));
}

TEST(AtomicFile, writes_side_by_side) {
  const TemporaryFolder folder;
  const std::string one(200'000, '1'), two(100'000, '2');
  const auto write = [&](const std::string& content) {
    for (int i = 0; i < 20; ++i) write_file(folder / "a.txt", content);
  };
  std::thread other([&] { write(one); });
  write(two);
  other.join();
  const std::string last = content_of(folder / "a.txt");
  EXPECT_TRUE(last == one || last == two);
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, names_file_and_reason_when_the_folder_is_a_file) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  const auto path = folder / "file" / "a.txt";
  const std::string message = message_of<ComputationError>([&] { write_file(path, "x"); });
  EXPECT_THAT(message, HasSubstr(path.string()));
  EXPECT_THAT(message, HasSubstr("Not a directory"));
}

TEST(AtomicFile, names_the_reason_when_the_folder_is_missing) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<ComputationError>([&] { write_file(folder / "no" / "a.txt", "x"); }),
              HasSubstr("No such file or directory"));
}

TEST(AtomicFile, names_the_reason_when_the_disk_is_full) {
  const int full = open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  const std::string message =
      message_of<ComputationError>([&] { detail::write_all(full, "content", "results/summary.json"); });
  close(full);
  EXPECT_EQ(message, "cannot write results/summary.json: No space left on device");
}

TEST(AtomicFile, says_when_a_folder_may_not_be_written_to) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_read);
  EXPECT_THAT(message_of<ComputationError>([&] { write_file(folder / "closed" / "a", "x"); }),
              HasSubstr("Permission denied"));
}

TEST(AtomicFile, keeps_the_old_file_and_no_temporary_one_when_writing_fails) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  const auto fail_half_way = [](const std::filesystem::path& temporary) {
    put(temporary, "half");
    throw ComputationError("half way");
  };
  EXPECT_EQ(message_of<ComputationError>([&] { replace_file(folder / "a.txt", fail_half_way); }), "half way");
  EXPECT_EQ(content_of(folder / "a.txt"), "old");
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, keeps_the_old_file_when_the_disk_fills_up_half_way) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  const FileSizeLimit limit(1000);
  EXPECT_THAT(message_of<ComputationError>([&] { write_file(folder / "a.txt", std::string(5000, 'x')); }),
              HasSubstr("a.txt: File too large"));
  EXPECT_EQ(content_of(folder / "a.txt"), "old");
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, leaves_no_temporary_file_when_the_renaming_fails) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THAT(message_of<ComputationError>([&] { write_file(folder / "taken", "x"); }), HasSubstr("Is a directory"));
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, replaces_through_a_callback) {
  const TemporaryFolder folder;
  replace_file(folder / "a.txt", [](const std::filesystem::path& temporary) { put(temporary, "new"); });
  EXPECT_EQ(content_of(folder / "a.txt"), "new");
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(AtomicFile, makes_folders_or_says_why_not) {
  const TemporaryFolder folder;
  make_folder(folder / "a" / "b");
  make_folder(folder / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a" / "b"));
  put(folder / "file", "");
  EXPECT_THAT(message_of<ComputationError>([&] { make_folder(folder / "file" / "b"); }), HasSubstr("file/b"));
}

}  // namespace
}  // namespace pfdm::test::this_file
