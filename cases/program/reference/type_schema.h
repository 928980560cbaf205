#pragma once
// JSON schemas of what may stand at a key.

#include "cases/program/input/config/key.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace pfdm {

/// Types of one key in several tables.
using SchemaTypes = std::vector<const KeyType*>;

/// The schema of one key in tables that share a place: such tables become one, so that an editor marks the line that is
/// wrong.
nlohmann::ordered_json schema_of_types(const SchemaTypes& types);

/// Adds what stands once among the definitions, as it is the same for many keys.
void add_definitions(const KeyType& type, nlohmann::ordered_json& definitions);

}  // namespace pfdm
