#pragma once
// All keys of all kinds of case as a tree of tables: what pfdm help KEY, the schema and the reference walk through.

#include "cases/program/input/config/key.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The files of one kind of case.
struct KindKeys {
  std::string_view kind;
  std::vector<const KeyTable*> roots;  ///< a table for each way in which its files are read
};

/// A key where it stands.
struct PlacedKey {
  std::string_view kind;
  std::string path;  ///< "materials.NAME.poisson_ratio", "mesh.particles[].diameter"
  const KeyTable* table;
  const Key* key;
};

/// The tables that stand directly below a key of this type, and how their path goes on: "" of a table, "[]" of one in a
/// list, ".NAME" of one whose name the user chooses.
struct SubTable {
  const KeyTable* rows;
  std::string way;
};
std::vector<SubTable> tables_below(const KeyType& type);

/// Calls `see` with every key; a table that stands at several places is walked through at each.
void for_each_key(const std::vector<KindKeys>& kinds, const std::function<void(const PlacedKey&)>& see);

}  // namespace pfdm
