#include "physics/system/machine_limits.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <thread>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// The first numbers of a file; of a file that is not there, or that begins with a word ("max"), none.
std::vector<double> numbers_in(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// The groups of a controller ("" in version 2) to which the process belongs, from its own up to the root.
std::vector<fs::path> groups_of(const fs::path& memberships, const std::string& controller) {
  std::vector<fs::path> groups{""};
  std::ifstream stream(memberships);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string names = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    if (names.find(fmt::format(",{},", controller)) == std::string::npos) continue;
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path(); !group.empty();
         group = group.parent_path())
      groups.push_back(group);
  }
  return groups;
}

void lower(double& limit, double to) {
  if (to > 0.0) limit = std::min(limit, to);
}

}  // namespace

MachineLimits machine_limits(const fs::path& groups, const fs::path& memberships) {
  double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  double processors = std::max(1U, std::thread::hardware_concurrency());
  for (const fs::path& group : groups_of(memberships, "")) {
    if (const auto most = numbers_in(groups / group / "memory.max"); !most.empty()) lower(memory, most[0]);
    if (const auto quota = numbers_in(groups / group / "cpu.max"); quota.size() == 2)
      lower(processors, quota[0] / quota[1]);
  }
  for (const fs::path& group : groups_of(memberships, "memory"))
    if (const auto most = numbers_in(groups / "memory" / group / "memory.limit_in_bytes"); !most.empty())
      lower(memory, most[0]);
  for (const fs::path& group : groups_of(memberships, "cpu")) {
    const auto quota = numbers_in(groups / "cpu" / group / "cpu.cfs_quota_us");
    const auto period = numbers_in(groups / "cpu" / group / "cpu.cfs_period_us");
    if (!quota.empty() && !period.empty()) lower(processors, quota[0] / period[0]);  // -1: no limit
  }
  return {.processors = std::max(1, static_cast<int>(std::lround(processors))), .memory = memory};
}

void require_memory(double need, const std::string& what, const MachineLimits& machine) {
  if (need <= machine.memory) return;
  throw InputError(fmt::format("{} would take about {:.3g} GB of memory; there are {:.3g} GB here", what, 1e-9 * need,
                               1e-9 * machine.memory));
}

}  // namespace pfdm
