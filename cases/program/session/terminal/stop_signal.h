#pragma once
// Ctrl-C (SIGINT) and SIGTERM. Long loops look between their iterations whether one has come and end in order;
// elsewhere it ends the process at once, as does a second one: results can be continued after a kill at any moment.

#include <stdexcept>
#include <string>

namespace pfdm {

/// Thrown where a loop has seen the signal. what() says what is there.
struct Interrupted : std::runtime_error {
  Interrupted(int which, const std::string& what) : std::runtime_error(what), signal(which) {}
  int signal;
};

/// What shells show of a process that a signal has ended.
inline int exit_status_of_signal(int signal) { return 128 + signal; }

/// Ends this process by the signal itself: a shell that runs a loop continues it after any other end.
[[noreturn]] void end_by_signal(int signal);

/// While it lives both signals are handled here; one that was ignored before stays so. One object at a time.
class StopSignals {
 public:
  /// `at_once`: what is said on standard error when the process ends without a look.
  explicit StopSignals(std::string at_once);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// While it lives a loop looks: the first signal only leaves its number for it.
class LooksForStop {
 public:
  LooksForStop();
  ~LooksForStop();
  LooksForStop(const LooksForStop&) = delete;
  LooksForStop& operator=(const LooksForStop&) = delete;
};

/// Throws Interrupted if a signal has come since the StopSignals were made.
void stop_if_asked();

/// Lets this process end as by SIGTERM when the one ends that started it, where that is the process whose number is in
/// the environment as PFDM_PARENT: a script that is killed leaves no run behind. The name goes from the environment, as
/// it is not of the programs that this one starts.
void end_with_parent();

/// In a new process: signals do what they did before the StopSignals were made.
void leave_stop_signals();

}  // namespace pfdm
