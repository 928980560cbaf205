#pragma once
// Prescribed stresses and strains over time: plain values, formulas, tables and columns of CSV files.

#include "cases/program/input/config.h"
#include "postproc/files/csv_table.h"
#include "solver/point/mixed_control.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// A column of a file in SI: { csv = "data/x.csv", column = "s", unit = "MPa" }, by its name or number (from 1).
/// Without a unit in the case that of the file counts: of its row of units, in brackets at the end of the name, or the
/// end of the name after _; else `due.si_unit`. Throws InputError where case and file contradict each other.
std::vector<double> read_column(const ConfigTable& table, const CsvTable& file, std::string_view column_key,
                                std::string_view unit_key, const Dimension& due);

/// The file that `csv` names, with the line of the case for messages; `separator` and `decimal` if the case gives them.
CsvTable read_csv_of(const ConfigTable& table, const std::filesystem::path& case_directory);

/// Times of the file from 0 on, rising [s]: columns "time" (time_s) in "time_unit" (s).
std::vector<double> file_times(const ConfigTable& table, const std::filesystem::path& case_directory);

/// Sets pace and values of `condition` at `times`: a plain value (reached linearly at the end), { expr, unit } in t,
/// the seconds since the segment began, { table = [["0 s", 0.01], ...] } or a column of a file, both linear in between.
void read_control_value(const ConfigValue& value, bool is_stress, const std::vector<double>& times,
                        const std::filesystem::path& case_directory, std::vector<std::filesystem::path>& files,
                        LoadSegment::Condition& condition);

}  // namespace pfdm
