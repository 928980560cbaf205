#pragma once
// pfdm sweep: runs of a case of any kind with many sets of values, and one table of what came out.

#include "cases/program/session/session.h"
#include "cases/program/studies/sweep/sweep_case.h"

namespace pfdm {

/// Writes sweep.csv to session.results, the runs to runs/ there, which a fit uses as well. Killed at any moment it goes
/// on at the next call with the runs that it left. With session.slurm, runs that are not there are handed to Slurm
/// instead, and the table is written by a later call that finds them.
void run_sweep(const CaseFile& file, const SweepSettings& settings, Session& session);

/// Says how many runs the sweep has, and with which values; warns of sets of values that the case's own rules exclude.
void say_sweep(const CaseFile& file, const SweepSettings& settings, Session& session);

}  // namespace pfdm
