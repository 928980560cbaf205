#pragma once
// Sweeps of method "changes": the case as it is, and with each of the changes that [sweep.changes] names, as a finer
// mesh or shorter steps. So the error of its figures is told, each part of it alone.

#include "cases/program/studies/sweep/sweep_case.h"
#include "postproc/files/csv_table.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Of [sweep] with a table `changes`. Whether the case has their keys is asked when they are made: a run of the case
/// does not need that.
SweepSettings read_changes(const ConfigTable& sweep);
/// The case, and with each change. Throws InputError, with file and line, for a key that it has not.
std::vector<CaseVariant> changed_cases(const CaseFile& file);

/// The only column of sweep.csv for what is changed, by number.
inline constexpr const char* change_column = "change";
/// How the comments of sweep.csv begin that have these lines.
inline constexpr std::string_view mark_of_changes = "changes: ";
/// What a comment of sweep.csv tells of changes; nothing of others.
std::optional<std::string> told_change(std::string_view comment);
/// The lines among the comments of a sweep's table.
std::vector<std::string> told_changes(const CsvTable& table);

/// A sentence on the change that does most to each of the figures that one asks for first; empty of other sweeps.
std::string most_of_changes(const CsvTable& table);

/// A sentence on the error of mesh and steps of a run with this greatest force [N]: what the sweep in its results says,
/// if there is one of the same case, or how to know it.
std::string words_of_error(const std::filesystem::path& results, double peak_force);

/// What each change does to the figures that one asks for first, in per cent of those of the case as it is: a line of
/// each figure. Of kinds of case without such figures, to those that differ. `table`: of the sweep's runs, in order.
/// None of sweeps of other methods, or where the case itself failed.
std::vector<std::string> lines_of_changes(const SweepSettings& settings, const CsvTable& table);

}  // namespace pfdm
