#include "physics/error.h"
#include "postproc/files/folder_lock.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <utility>

namespace pfdm::test::this_file {
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

TEST(FolderLock, leaves_folders_of_others_alone) {
  const TemporaryFolder folder;
  put(folder / ".notes.partial", "mine");
  put(folder / "notes.txt", "mine");
  EXPECT_THAT(
      message_of<InputError>([&] { FolderLock lock(folder.path()); }),
      HasSubstr("holds files that are not of pfdm, as \".notes.partial\": choose another folder with --output"));
  EXPECT_EQ(content_of(folder / ".notes.partial"), "mine");
  EXPECT_EQ(folder.n_entries(), 2u);
  put(folder / owned_folder_mark, "");
  EXPECT_NO_THROW(FolderLock lock(folder.path()));
  EXPECT_EQ(content_of(folder / "notes.txt"), "mine");
}

TEST(FolderLock, knows_results_of_earlier_versions) {
  const std::pair<const char*, const char*> results[] = {
      {"summary.json", "{\n  \"case\": \"bar\",\n  \"case_hash\": \"9e75f4c6587ac82b\"\n}\n"},
      {"fit.json", "{\n  \"format\": 1,\n  \"case_hash\": \"9e75f4c6587ac82b\"\n}\n"},
      {"run.log", "2026-11-29 13:54:41 pfdm 0.2.0 (x86-64-v3), case bar; 1 thread\n"},
      {"checkpoint.bin", "PFDMCKPT\x01"},
      {"case.toml", "# Kept by pfdm 0.2.0: the case \"b\" of \"..\" as it ran. Paths start here.\n"}};
  for (const auto& [name, content] : results) {
    const TemporaryFolder folder;
    put(folder / name, content);
    EXPECT_NO_THROW(FolderLock lock(folder.path())) << name;
    EXPECT_TRUE(std::filesystem::exists(folder / owned_folder_mark)) << name;
  }
}

// Names that results have, too, with contents of others.
TEST(FolderLock, takes_no_name_for_results) {
  const std::pair<const char*, const char*> files[] = {{"summary.json", "{\"mean\": 3}"},
                                                       {"fit.json", "[1, 2]"},
                                                       {"run.log", "2026-11-29 13:54:41 solver 3.1\n"},
                                                       {"checkpoint.bin", "PK"},
                                                       {"case.toml", "kind = \"fracture\"\n"},
                                                       {"force_displacement.csv", "displacement,force\n0,0\n"},
                                                       {"history.csv", "time,value\n"},
                                                       {"sweep.csv", "a,b\n"},
                                                       {"mesh.vtu", "<VTKFile>"},
                                                       {"compared.json", "{}"}};
  for (const auto& [name, content] : files) {
    const TemporaryFolder folder;
    put(folder / name, content);
    put(folder / ".X.partial", "mine");
    EXPECT_THAT(message_of<InputError>([&] { FolderLock lock(folder.path()); }),
                HasSubstr("holds files that are not of pfdm"))
        << name;
    EXPECT_EQ(content_of(folder / name), content);
    EXPECT_EQ(folder.n_entries(), 2u) << name;
  }
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "report");
  EXPECT_THROW(FolderLock lock(folder.path()), InputError);
}

TEST(FolderLock, refuses_links_whose_targets_a_run_would_empty) {
  const TemporaryFolder folder, other;
  put(other / "step_0001.vtu", "another's");
  put(folder / owned_folder_mark, "");
  std::filesystem::create_directory_symlink(other.path(), folder / "fields");
  EXPECT_THAT(message_of<InputError>([&] { FolderLock lock(folder.path()); }),
              HasSubstr((folder / "fields").string() + " is a link to a folder"));
  EXPECT_EQ(content_of(other / "step_0001.vtu"), "another's");
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
  mark_folder(folder.path());
  put(folder / ".a.txt.17_0.partial", "half");
  const FolderLock lock(folder.path());
  EXPECT_EQ(folder.n_entries(), 1u);
}

}  // namespace
}  // namespace pfdm::test::this_file
