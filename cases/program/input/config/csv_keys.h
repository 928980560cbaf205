#pragma once
// Rows of the keys that name CSV files, their layout and their columns, wherever data are read.

#include "cases/program/input/config/key.h"

#include <vector>

namespace pfdm {

/// "csv" and how its layout is read.
std::vector<Key> csv_keys();
/// How the layout of a file is read: "separator", "decimal", "thousands".
std::vector<Key> csv_mark_keys();
/// { column, unit }
const KeyTable& column_keys();
/// Name or number of a column.
KeyType column_type();

}  // namespace pfdm
