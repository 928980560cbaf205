#include "postproc/files/atomic_file.h"
#include "postproc/files/flush.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>

#include <thread>

namespace pfdm::test::this_file {
namespace {

using Seconds = FlushBudget::Duration;

// A disk that takes 30 ms for a file, work that takes 1 ms between two files.
TEST(FlushBudget, LetsShortWorkWaitForAFiftiethOfItsTime) {
  FlushBudget budget;
  double elapsed = 0.0, waited = 0.0;
  int n_flushed = 0;
  for (int i = 0; i < 10000; ++i) {
    elapsed += 1e-3;
    if (!budget.is_due(Seconds(elapsed))) continue;
    budget.add(Seconds(0.03));
    elapsed += 0.03;
    waited += 0.03;
    ++n_flushed;
  }
  EXPECT_LE(waited, FlushBudget::share * elapsed + 0.03);
  EXPECT_GE(n_flushed, 6);
}

TEST(FlushBudget, LetsLongWorkFlushEveryFile) {
  FlushBudget budget;
  for (int i = 1; i <= 100; ++i) {
    EXPECT_TRUE(budget.is_due(Seconds(2.0 * i))) << i;
    budget.add(Seconds(0.03));
  }
}

TEST(Flush, PassesOverWhatIsGone) {
  {
    const TemporaryFolder folder;
    for (int i = 0; i < 20; ++i) write_file(folder / ("a" + std::to_string(i)), "one");
    std::filesystem::remove(folder / "a3");
  }
  EXPECT_NO_THROW(flush_written_files());
}

TEST(Flush, ServesSeveralThreads) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name) {
    for (int i = 0; i < 200; ++i) write_file(folder / name, name);
    flush_written_files();
  };
  std::thread other([&] { write("one"); });
  write("two");
  other.join();
  EXPECT_EQ(content_of(folder / "one"), "one");
  EXPECT_EQ(content_of(folder / "two"), "two");
}

}  // namespace
}  // namespace pfdm::test::this_file
