#pragma once
// Prescribed stresses and strains over time: plain values, formulas, tables and columns of CSV files.

#include "cases/program/input/config/config.h"
#include "solver/point/mixed_control.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// Sets pace and values of `condition` at `times`: a plain value (reached linearly at the end), { expr, unit } in t,
/// the seconds since the segment began, { table = [["0 s", 0.01], ...] } or a column of a file, both linear in between.
void read_control_value(const ConfigValue& value, bool is_stress, const std::vector<double>& times,
                        const std::filesystem::path& case_directory, std::vector<std::filesystem::path>& files,
                        LoadSegment::Condition& condition);

/// The times of the rows of its CSV file that have one, from zero on.
std::vector<double> control_times(const ConfigTable& table, const std::filesystem::path& case_directory);

}  // namespace pfdm
