#include "solver/parallel.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace pfdm {
namespace {

// Workers wait a short while actively, since loops follow each other closely, then sleep.
class ThreadPool {
 public:
  ~ThreadPool() { stop(); }

  void resize(int n) {
    if (n == size()) return;
    stop();
    stopping_ = false;
    for (int i = 1; i < n; ++i) workers_.emplace_back([this, seen = generation_.load()] { work(seen); });
  }

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  void run(Index n_tasks, const std::function<void(Index)>& task) {
    task_ = &task;
    n_tasks_ = n_tasks;
    next_.store(0, std::memory_order_relaxed);
    busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
    {
      const std::lock_guard lock(mutex_);
      generation_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_all();
    take_tasks();
    while (busy_.load(std::memory_order_acquire) > 0) std::this_thread::yield();
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  void take_tasks() {
    for (Index i = next_.fetch_add(1); i < n_tasks_; i = next_.fetch_add(1)) {
      try {
        (*task_)(i);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
  }

  void work(long seen) {
    while (true) {
      for (int spin = 0; spin < 2000 && generation_.load(std::memory_order_acquire) == seen; ++spin)
        std::this_thread::yield();
      if (generation_.load(std::memory_order_acquire) == seen) {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return stopping_ || generation_.load(std::memory_order_acquire) != seen; });
      }
      if (stopping_) return;
      seen = generation_.load(std::memory_order_acquire);
      take_tasks();
      busy_.fetch_sub(1, std::memory_order_release);
    }
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      generation_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_all();
    for (std::thread& w : workers_) w.join();
    workers_.clear();
  }

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<long> generation_{0};
  std::atomic<bool> stopping_{false};
  std::atomic<Index> next_{0};
  std::atomic<int> busy_{0};
  const std::function<void(Index)>* task_ = nullptr;
  Index n_tasks_ = 0;
  std::exception_ptr error_;
};

ThreadPool& pool() {
  static ThreadPool instance;
  return instance;
}

}  // namespace

void set_threads(int n) { pool().resize(std::max(n, 1)); }

int n_threads() { return pool().size(); }

void detail::run_tasks(Index n_tasks, const std::function<void(Index)>& task) {
  if (n_tasks > 1 && pool().size() > 1) {
    pool().run(n_tasks, task);
    return;
  }
  for (Index i = 0; i < n_tasks; ++i) task(i);
}

}  // namespace pfdm
