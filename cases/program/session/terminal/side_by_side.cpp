#include "cases/program/session/terminal/side_by_side.h"

#include "cases/program/session/terminal/stop_signal.h"
#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <system_error>
#include <thread>

namespace pfdm {
namespace {

constexpr std::chrono::milliseconds between_looks{5};
constexpr int threw = 101;  // exit status of a job that did not return

[[noreturn]] void do_job(const Job& job, int threads, pid_t parent) {
  leave_stop_signals();  // results can be continued after a kill
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(threw);  // it died before it could be asked to tell
  int status = threw;
  try {
    set_threads(threads);
    status = job.work(threads);
  } catch (...) {
  }
  ::_exit(status);  // without the destructors and buffers of the process that this one was copied from
}

/// The processes that run now; killed with the object.
class Running {
 public:
  Running() = default;
  ~Running() {
    for (const auto& [pid, process] : processes_) ::kill(pid, SIGKILL);
    for (const auto& [pid, process] : processes_) ::waitpid(pid, nullptr, 0);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  bool empty() const { return processes_.empty(); }
  int threads() const {
    int sum = 0;
    for (const auto& [pid, process] : processes_) sum += process.threads;
    return sum;
  }

  void start(const Job& job, int threads) {
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0)
      throw ComputationError(fmt::format("no process can be started: {}", std::generic_category().message(errno)));
    if (pid == 0) do_job(job, threads, parent);
    processes_[pid] = {&job, threads};
  }

  /// Waits until one of them ends. Throws Interrupted if the user wants an end.
  void wait() {
    const LooksForStop looks;
    siginfo_t info{};
    // No call waits for a child or a signal, whichever is first, without a gap in which the signal is missed.
    while (info.si_pid == 0) {
      stop_if_asked();
      if (::waitid(P_ALL, 0, &info, WEXITED | WNOWAIT | WNOHANG) != 0 && errno != EINTR)
        throw ComputationError("a process that was started disappeared");
      if (info.si_pid == 0) std::this_thread::sleep_for(between_looks);
    }
    stop_if_asked();  // what has ended the child may have been the same Ctrl-C
    int status = 0;
    ::waitpid(info.si_pid, &status, 0);
    const auto found = processes_.find(info.si_pid);
    if (found == processes_.end()) return;
    const Job& job = *found->second.job;
    processes_.erase(found);
    JobEnd end;
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end.status = WIFEXITED(status) && WEXITSTATUS(status) < threw ? WEXITSTATUS(status) : -1;
    job.ended(end);
  }

 private:
  struct Process {
    const Job* job;
    int threads;
  };
  std::map<pid_t, Process> processes_;
};

}  // namespace

void run_side_by_side(const std::vector<Job>& jobs, int cores) {
  set_threads(1);  // a process is copied without the threads of its pool
  Running running;
  for (std::size_t next = 0; next < jobs.size() || !running.empty();) {
    const int free = cores - running.threads();
    const auto waiting = static_cast<int>(jobs.size() - next);
    if (waiting > 0 && free > 0)
      running.start(jobs[next++], std::max(1, free / waiting));
    else
      running.wait();
  }
}

}  // namespace pfdm
