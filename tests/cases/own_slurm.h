#pragma once
// A Slurm of a test's own on this machine: controller, one node with two processors, and the munge daemon by which they
// know each other, in a temporary folder, for any user.

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

class OwnSlurm {
 public:
  /// The first of the programs it needs that is not installed.
  static std::optional<std::string> missing_program();

  /// Returns when the node takes jobs; the commands of this process and its children then speak to it. Throws
  /// std::runtime_error with the daemons' last words if that takes more than a minute.
  OwnSlurm();
  /// Stops what it started.
  ~OwnSlurm();
  OwnSlurm(const OwnSlurm&) = delete;
  OwnSlurm& operator=(const OwnSlurm&) = delete;

  /// Until no job is queued or running, a minute at most; false if there still are.
  bool wait_for_jobs() const;
  /// Until so many tasks are running, likewise.
  bool wait_for_running(int tasks) const;

 private:
  void configure() const;
  void start(const std::vector<std::string>& words);
  void stop();

  std::filesystem::path folder_;
  std::vector<pid_t> daemons_;
};

}  // namespace pfdm
