#pragma once
// Laws are rows of tables; this finds a row by its name.

#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

/// Throws InputError that names the kind of law and every row there is.
template <class Law>
const Law& find_by_name(std::span<const Law> table, std::string_view name, std::string_view kind) {
  for (const Law& law : table)
    if (law.name == name) return law;
  std::vector<std::string_view> names;
  for (const Law& law : table) names.push_back(law.name);
  throw InputError(fmt::format("unknown {} \"{}\"; available: {}", kind, name, fmt::join(names, ", ")));
}

}  // namespace pfdm
