#pragma once
// JSON schemas of tables: which keys there are, and which have to be.

#include "cases/program/input/config/key.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace pfdm {

/// Tables that may stand at one place.
using SchemaTables = std::vector<const KeyTable*>;

/// The schema of a place where one of these tables, at least one, stands.
nlohmann::ordered_json schema_of_tables(const SchemaTables& tables);

}  // namespace pfdm
