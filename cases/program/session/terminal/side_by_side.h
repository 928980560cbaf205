#pragma once
// Jobs in processes of their own, side by side on the cores: one that fails or crashes leaves the others alone, and
// none outlives this process. What they have in common they find in memory as it was here.

#include <functional>
#include <string>
#include <vector>

namespace pfdm {

/// What a job came to.
struct JobEnd {
  int status = 0;  ///< what the job returned; -1 if it was killed or threw
  int signal = 0;  ///< that killed it, or 0
};

struct Job {
  /// In the new process, with so many threads for its loops. Its status is 0 ... 100.
  std::function<int(int threads)> work;
  /// Here, when it has ended.
  std::function<void(const JobEnd& end)> ended;
};

/// Returns when all have ended. At most `cores` run at a time; as long as fewer wait than there are cores, they share
/// them. If `ended` throws, or with Interrupted after Ctrl-C (stop_signal.h), the jobs that still run are killed.
/// Leaves this process with one thread for its loops.
void run_side_by_side(const std::vector<Job>& jobs, int cores);

}  // namespace pfdm
