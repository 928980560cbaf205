#pragma once
// The keys "separator", "decimal" and "thousands" beside the name of a CSV file, where its layout cannot be found.

#include "cases/program/input/config/config.h"
#include "postproc/files/csv_table.h"

namespace pfdm {

/// Throws InputError with the place in the file for other marks, or one for both.
CsvMarks read_csv_marks(const ConfigTable& table);

}  // namespace pfdm
