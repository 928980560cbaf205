#include "cases/program/session/terminal/stop_signal.h"

#include "postproc/files/text_file.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <utility>

namespace pfdm {
namespace {

constexpr std::array<int, 2> stop_signals{SIGINT, SIGTERM};

// A handler may touch lock-free atomics only; the text does not change while it is installed.
std::atomic<int> asked{0}, n_looking{0};
std::atomic<pid_t> parent_to_end_with{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);
std::string said_at_once;
std::array<struct sigaction, stop_signals.size()> before{};
bool installed = false;

void say_from_handler() {
  const char* text = said_at_once.data();
  std::size_t left = said_at_once.size();
  while (left > 0) {
    const ssize_t written = ::write(STDERR_FILENO, text, left);
    if (written <= 0) return;
    text += written;
    left -= static_cast<std::size_t>(written);
  }
}

// A parent of several threads dies once for each of them (prctl(2)).
bool dies_again(int signal, const siginfo_t& from) {
  return signal == SIGTERM && from.si_pid != 0 && from.si_pid == parent_to_end_with.load();
}

extern "C" void on_stop_signal(int signal, siginfo_t* from, void*) {
  const int error = errno;
  int none = 0;
  const bool first = asked.compare_exchange_strong(none, signal);
  if ((!first && !dies_again(signal, *from)) || (first && n_looking.load() == 0)) {
    say_from_handler();
    end_by_signal(signal);
  }
  errno = error;
}

}  // namespace

void end_by_signal(int signal) {
  sigset_t only_this;
  ::sigemptyset(&only_this);
  ::sigaddset(&only_this, signal);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
  ::pthread_sigmask(SIG_UNBLOCK, &only_this, nullptr);  // it is blocked in its own handler
  ::_exit(exit_status_of_signal(signal));
}

StopSignals::StopSignals(std::string at_once) {
  said_at_once = std::move(at_once);
  asked = 0;
  for (std::size_t i = 0; i < stop_signals.size(); ++i) {
    ::sigaction(stop_signals[i], nullptr, &before[i]);
    if (before[i].sa_handler == SIG_IGN) continue;  // as under nohup
    struct sigaction action {};
    action.sa_sigaction = on_stop_signal;
    action.sa_flags = SA_RESTART | SA_SIGINFO;
    ::sigaction(stop_signals[i], &action, nullptr);
  }
  installed = true;
}

StopSignals::~StopSignals() { leave_stop_signals(); }

LooksForStop::LooksForStop() { ++n_looking; }

LooksForStop::~LooksForStop() { --n_looking; }

void stop_if_asked() {
  if (const int signal = asked.load()) throw Interrupted(signal, "interrupted");
}

void end_with_parent() {
  constexpr const char* name = "PFDM_PARENT";
  const char* number = std::getenv(name);
  const auto parent = number == nullptr ? std::nullopt : parse_int(number);
  ::unsetenv(name);
  if (!parent || ::getppid() != *parent) return;  // started by something between them, which may be left alone
  parent_to_end_with = static_cast<pid_t>(*parent);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != *parent) end_by_signal(SIGTERM);  // it ended before that was asked for
}

void leave_stop_signals() {
  if (!std::exchange(installed, false)) return;
  for (std::size_t i = 0; i < stop_signals.size(); ++i) ::sigaction(stop_signals[i], &before[i], nullptr);
}

}  // namespace pfdm
