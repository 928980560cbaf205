#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "solver/parallel.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

using Parallel = WithThreads;

constexpr Index sizes[] = {0, 1, chunk_size - 1, chunk_size, chunk_size + 1, 7 * chunk_size + 123};

TEST_F(Parallel, VisitsEveryItemOnce) {
  for (const int threads : {1, 2, 3, 4}) {
    set_threads(threads);
    EXPECT_EQ(n_threads(), threads);
    for (const Index n : sizes) {
      std::vector<std::atomic<int>> visits(n);
      parallel_for(n, [&](Index i) { ++visits[i]; });
      for (const auto& count : visits) ASSERT_EQ(count, 1) << n << " items, " << threads << " threads";
    }
  }
}

// A worker that comes late to one loop must not do a task of it for the next one.
TEST_F(Parallel, LoopsThatFollowEachOtherAtOnceKeepTheirTasksApart) {
  for (const int threads : {2, 3, 4, 8}) {
    set_threads(threads);
    for (int loop = 0; loop < 2000; ++loop) {
      const Index n = 1 + loop % 5;
      std::vector<int> done(n, -1);
      detail::run_tasks(n, [&](Index i) { done[i] = loop + i; });
      for (Index i = 0; i < n; ++i) ASSERT_EQ(done[i], loop + i) << threads << " threads";
    }
  }
}

TEST_F(Parallel, SumsAreBitwiseTheSameForAnyNumberOfThreads) {
  // Terms of very different size: any other order of summation gives another last digit.
  const auto term = [](Index i) { return std::sin(1.0 + i) * std::pow(10.0, i % 17); };
  for (const Index n : sizes) {
    set_threads(1);
    const double expected = parallel_sum(n, term);
    for (const int threads : {2, 3, 4}) {
      set_threads(threads);
      for (int repeat = 0; repeat < 20; ++repeat) ASSERT_EQ(parallel_sum(n, term), expected) << n << ' ' << threads;
    }
  }
}

TEST_F(Parallel, SumsAnyTypeThatAdds) {
  set_threads(3);
  const Index n = 3 * chunk_size + 1;
  const Vector sum = parallel_sum<Vector>(
      n, [](Index i) { return Vector(1.0, i, -1.0); }, Vector::Zero());
  EXPECT_EQ(sum, Vector(n, 0.5 * n * (n - 1.0), -n));
}

TEST_F(Parallel, LargestIsThatOfAllChunks) {
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    for (const Index peak : {0, 1, chunk_size, 5 * chunk_size + 7})
      EXPECT_EQ(parallel_max(
                    6 * chunk_size, [&](Index i) { return i == peak ? 2.5 : -1.0; }, -3.0),
                2.5);
    EXPECT_EQ(parallel_max(
                  0, [](Index) { return 1.0; }, -3.0),
              -3.0);
    EXPECT_EQ(parallel_max(
                  10, [](Index) { return -5.0; }, -3.0),
              -3.0);
  }
}

TEST_F(Parallel, ExceptionsPassThroughAndTheLoopsGoOnWorking) {
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    const auto fails = [](Index i) {
      if (i == 4 * chunk_size + 5) throw std::runtime_error("cell 8197");
    };
    try {
      parallel_for(10 * chunk_size, fails);
      ADD_FAILURE() << "nothing was thrown with " << threads << " threads";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "cell 8197");
    }
    EXPECT_EQ(parallel_sum(3 * chunk_size, [](Index) { return 1.0; }), 3.0 * chunk_size);
  }
}

TEST_F(Parallel, SeveralCallersAtATimeGetTheSameSums) {
  const auto term = [](Index i) { return std::sin(1.0 + i) * std::pow(10.0, i % 17); };
  const Index n = 5 * chunk_size + 17;
  set_threads(1);
  const double expected = parallel_sum(n, term);
  set_threads(3);
  std::vector<int> right(3, 0);
  std::vector<std::thread> callers;
  for (int& count : right)
    callers.emplace_back([&] {
      for (int repeat = 0; repeat < 50; ++repeat) count += parallel_sum(n, term) == expected ? 1 : 0;
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(right, std::vector<int>(3, 50));
}

TEST_F(Parallel, LoopsWithinLoopsAreDone) {
  set_threads(3);
  std::vector<double> sums(3 * as_size(chunk_size), 0.0);
  parallel_for(count_of(sums), [&](Index i) {
    if (i % chunk_size == 7) sums[i] = parallel_sum(2 * chunk_size, [](Index) { return 1.0; });
  });
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0.0), 6.0 * chunk_size);
}

TEST_F(Parallel, AtLeastOneThread) {
  set_threads(0);
  EXPECT_EQ(n_threads(), 1);
  set_threads(-3);
  EXPECT_EQ(n_threads(), 1);
}

}  // namespace
}  // namespace pfdm::this_file
