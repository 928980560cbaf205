#pragma once
// Sweeps of method "changes": the case as it is, and with each of the changes that [sweep.changes] names, as a finer
// mesh or shorter steps. So the error of its figures is told, each part of it alone.

#include "cases/program/studies/sweep/sweep_case.h"
#include "postproc/files/csv_table.h"

#include <string>
#include <vector>

namespace pfdm {

/// Of [sweep] with a table `changes`. Throws InputError, with file and line, for a key that the case has not.
SweepSettings read_changes(const ConfigTable& sweep, const CaseFile& file);

/// What each change does to the figures that one asks for first, in per cent of those of the case as it is: a line of
/// each figure. `table`: of the sweep's runs, in order. None of sweeps of other methods, or where the case itself
/// failed.
std::vector<std::string> lines_of_changes(const SweepSettings& settings, const CsvTable& table);

}  // namespace pfdm
