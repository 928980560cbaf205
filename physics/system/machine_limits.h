#pragma once
// Processors and memory that this process may use, with the limits of control groups (containers, batch systems).

#include <filesystem>
#include <string>

namespace pfdm {

struct MachineLimits {
  int processors = 1;   ///< a share of one counts as one
  double memory = 0.0;  ///< [bytes]
};

/// `groups`: where the file systems of control groups are, `memberships`: the file that says to which of them this
/// process belongs, both of version 1 (a folder for cpu and memory each) and of version 2. What is not there limits
/// nothing.
MachineLimits machine_limits(const std::filesystem::path& groups = "/sys/fs/cgroup",
                             const std::filesystem::path& memberships = "/proc/self/cgroup");

/// Throws InputError if `need` [bytes] is more than this machine has; `what` needs it: "the mesh of 3e+08 cells".
void require_memory(double need, const std::string& what, const MachineLimits& machine = machine_limits());

}  // namespace pfdm
