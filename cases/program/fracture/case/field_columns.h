#pragma once
// Columns of the files that DIC programs export: found by the names that these give them, in SI.

#include "cases/program/input/config/config.h"
#include "postproc/files/csv_table.h"

#include <optional>
#include <string_view>
#include <vector>

namespace pfdm {

/// A coordinate or a displacement: "x", "y", "z", "u", "v" or "w" [m]; NaN where an entry is empty. The column is that
/// of the table { column, unit, factor } of this key in `field`, or is found by its name: X and x, coor.X (MatchID),
/// COORDINATE_X (DICe), pos_x (pyDIC) and their like. Its unit is that of the table, of the file, or of the key "unit"
/// of `field`; pixels are as long as "pixel" says. Nothing where the file has no such column and the key is not there.
/// Throws InputError where the unit is not known.
std::optional<std::vector<double>> find_field_column(const ConfigTable& field, const CsvTable& file,
                                                     std::string_view key);

}  // namespace pfdm
