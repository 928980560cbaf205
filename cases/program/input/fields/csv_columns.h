#pragma once
// Columns of CSV files that a case names, in SI.

#include "cases/program/input/config/config.h"
#include "postproc/files/csv_table.h"

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

/// How many SI units the unit at `key` is; 1 if the table has no such key.
double read_unit(const ConfigTable& table, std::string_view key, const Dimension& due);

/// A column of a file in SI: { csv = "data/x.csv", column = "s", unit = "MPa" }, by its name or number (from 1); NaN
/// where an entry is empty. Without a unit in the case that of the file counts: of its row of units, in brackets at the
/// end of the name, or the end of the name after _; else `due.si_unit`. Throws InputError where case and file
/// contradict each other, and where an entry is text.
std::vector<double> read_column(const ConfigTable& table, const CsvTable& file, std::string_view column_key,
                                std::string_view unit_key, const Dimension& due);

/// "kN" of force_kN: the end of a name after _, if it is a unit that is due; else empty.
std::string_view unit_of_name(std::string_view name, const Dimension& due);

/// Which column of the file a name or a number from 1 means. Throws InputError where there is none.
std::size_t find_column(const ConfigValue& name, const CsvTable& file);

/// Leaves out the rows of columns of one file in which one of them has an empty entry; `table` remarks how many. Throws
/// InputError if none is left.
void leave_out_gaps(const ConfigTable& table, std::span<std::vector<double>* const> columns);

/// The file that `csv` names, with the line of the case for messages; `separator`, `decimal` and `thousands` if the
/// case gives them.
CsvTable read_csv_of(const ConfigTable& table, const std::filesystem::path& case_directory);

/// Times since the first that the file has [s]: column "time" (time_s) in "time_unit" (s); NaN where an entry is empty.
std::vector<double> read_times(const ConfigTable& table, const CsvTable& file);

/// Times from 0 on. Throws InputError if they do not rise, or are fewer than two.
void begin_at_zero(const ConfigTable& table, std::vector<double>& times);

}  // namespace pfdm
