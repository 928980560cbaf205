#pragma once
// A sweep on the nodes of a cluster: one task of a job array for each run. Needs results that all nodes see under the
// same path.

#include "cases/program/studies/runs/case_runs.h"
#include "cases/program/studies/runs/slurm.h"

#include <span>

namespace pfdm {

/// Submits the runs that are `missing`, unless those of an earlier call have not ended yet, and says what to do next.
/// results/sweep/ gets the script job.sh, tasks.txt with the run of each task, each run's case as RUN.toml, and the
/// tasks' logs.
void hand_to_slurm(const CaseFile& file, const SlurmSettings& settings, std::span<const MissingRun> missing,
                   Session& session);

/// Throws InputError while tasks that hand_to_slurm() submitted from these results are queued or running.
void require_no_tasks_of(const Session& session);

/// What a task does: makes one of the prepared runs. `directory` is the case directory; case.toml may have changed.
void make_prepared_run(const std::filesystem::path& directory, const std::string& run, Session& session);

}  // namespace pfdm
