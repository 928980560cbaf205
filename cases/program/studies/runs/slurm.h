#pragma once
// Slurm, which runs jobs on the nodes of a cluster: its job arrays, through its own commands (sbatch, squeue; Slurm
// 20.02 or later). The only place that knows them.

#include "cases/program/input/config/config.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// What a task asks for; what is not said the cluster decides.
struct SlurmSettings {
  std::string partition;
  std::optional<double> time;  ///< limit of a task [s]
  int cpus_per_task = 1;
  std::string memory;              ///< of a task, as Slurm writes it: "4G"
  int at_once = 0;                 ///< tasks that may run at a time; 0: no limit
  int largest_array = 1000;        ///< tasks of one submission; Slurm's own limit is that by default
  std::vector<std::string> lines;  ///< of the script, before the program is started
};

/// [sweep.slurm]. Throws InputError.
SlurmSettings read_slurm(const ConfigTable& table);

/// Whether its commands are on the PATH.
bool slurm_is_here();
/// Throws InputError where they are not.
void require_slurm();

/// A script that runs `commands` once for each of `n_tasks`, which SLURM_ARRAY_TASK_ID numbers from 1; what task 7 says
/// goes to task_7.log.
std::string array_script(const SlurmSettings& settings, const std::string& name, std::size_t n_tasks,
                         const std::string& commands);

/// Submits `folder`/`script`, to be run in that folder. Returns the job's number. Throws ComputationError that says
/// what Slurm objects to.
std::string submit(const std::filesystem::path& folder, const std::string& script);

/// Tasks that were submitted in a folder and have not ended.
struct ActiveTasks {
  std::vector<std::string> jobs;  ///< their numbers
  int queued = 0;
  int running = 0;
  std::string reason;  ///< why a queued one waits, in Slurm's words
  bool any() const { return queued + running > 0; }
};
/// Throws ComputationError if Slurm does not answer.
ActiveTasks active_tasks(const std::filesystem::path& folder);

}  // namespace pfdm
