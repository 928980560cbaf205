#include "solver/parallel.h"

#include "solver/parallel_forks.h"

#include <pthread.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace pfdm {
namespace {

// Workers wait a short while actively, since loops follow each other closely, then sleep. A loop ends when its tasks
// are done, whether or not all workers have come: on a loaded machine a worker may come many loops late.
class ThreadPool {
 public:
  ~ThreadPool() { stop(); }

  void resize(int n) {
    if (n == size()) return;
    stop();
    stopping_ = false;
    for (int i = 1; i < n; ++i) workers_.emplace_back([this, seen = loop_of(ticket_)] { work(seen); });
    size_ = n;
  }

  int size() const { return size_; }

  void run(Index n_tasks, const std::function<void(Index)>& task) {
    const std::uint64_t loop = loop_of(ticket_);
    ticket_ = (loop << loop_shift) | all_taken;  // first: nobody then takes a task of one loop for another's
    task_ = &task;
    n_tasks_ = n_tasks;
    n_done_ = 0;
    {
      const std::lock_guard lock(mutex_);
      ticket_ = (loop + 1) << loop_shift;
    }
    wake_.notify_all();
    do_tasks();
    while (n_done_ < n_tasks) std::this_thread::yield();
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  static constexpr int loop_shift = 32;
  static constexpr std::uint64_t all_taken = 0xffffffff;
  static std::uint64_t loop_of(std::uint64_t ticket) { return ticket >> loop_shift; }

  void do_tasks() {
    std::uint64_t ticket = ticket_;
    while (true) {
      const auto* task = task_.load();
      const std::uint64_t i = ticket & all_taken;
      if (i >= static_cast<std::uint64_t>(n_tasks_.load())) return;
      if (!ticket_.compare_exchange_weak(ticket, ticket + 1)) continue;  // with the ticket as it is now
      try {
        (*task)(static_cast<Index>(i));
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
      ++n_done_;
      ticket = ticket_;
    }
  }

  void work(std::uint64_t seen) {
    while (true) {
      for (int spin = 0; spin < 2000 && loop_of(ticket_) == seen; ++spin) std::this_thread::yield();
      if (loop_of(ticket_) == seen) {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return stopping_ || loop_of(ticket_) != seen; });
      }
      if (stopping_) return;
      seen = loop_of(ticket_);
      do_tasks();
    }
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      ticket_ = ((loop_of(ticket_) + 1) << loop_shift) | all_taken;
    }
    wake_.notify_all();
    for (std::thread& w : workers_) w.join();
    workers_.clear();
  }

  std::vector<std::thread> workers_;
  std::atomic<int> size_{1};  // the thread that runs a loop is one of them
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint64_t> ticket_{0};  // number of the loop, and of its next task in the lower half
  std::atomic<const std::function<void(Index)>*> task_{nullptr};
  std::atomic<Index> n_tasks_{0}, n_done_{0};
  std::exception_ptr error_;
};

ThreadPool& pool() {
  static ThreadPool instance;
  return instance;
}

// One loop at a time has the workers.
std::atomic_flag has_workers = ATOMIC_FLAG_INIT;

// That has them, until its end.
struct WorkersTaken {
  WorkersTaken() = default;
  WorkersTaken(const WorkersTaken&) = delete;
  WorkersTaken& operator=(const WorkersTaken&) = delete;
  ~WorkersTaken() { has_workers.clear(std::memory_order_release); }
};
bool take_workers() { return !has_workers.test_and_set(std::memory_order_acquire); }

}  // namespace

void set_threads(int n) {
  n = std::max(n, 1);
  if (n == pool().size()) return;
  while (!take_workers()) std::this_thread::yield();
  const WorkersTaken taken;
  pool().resize(n);
}

int n_threads() { return pool().size(); }

void keep_threads_out_of_forks() {
  static std::once_flag once;
  static int n = 1;  // of whoever has the workers
  const auto before = [] {
    while (!take_workers()) std::this_thread::yield();
    n = pool().size();
    pool().resize(1);
  };
  const auto in_parent = [] {
    const WorkersTaken taken;
    pool().resize(n);
  };
  const auto in_child = [] { const WorkersTaken taken; };
  std::call_once(once, [&] { pthread_atfork(before, in_parent, in_child); });
}

void detail::run_tasks(Index n_tasks, const std::function<void(Index)>& task) {
  if (n_tasks > 1 && pool().size() > 1 && take_workers()) {
    const WorkersTaken taken;
    pool().run(n_tasks, task);
    return;
  }
  for (Index i = 0; i < n_tasks; ++i) task(i);
}

}  // namespace pfdm
