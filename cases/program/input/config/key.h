#pragma once
// Keys of case files, each declared by one row: name, what may stand there, default, one sentence. The reader checks a
// table against its rows and reads by them; pfdm help, the schema for editors and the reference are made of them.

#include "cases/program/input/config/config.h"

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// What may stand at a key. A number or a quantity may also be one out of a result file (result_number.h).
struct KeyType {
  enum class Kind { text, boolean, whole, number, quantity, choice, list, table, names, either, anything };
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  Kind kind = Kind::anything;
  const Dimension* due = nullptr;           ///< of a quantity
  Range allowed = range::any;               ///< of a number or a quantity
  std::string noun{};                       ///< what a text is, or what is chosen: "linear solver"
  std::vector<std::string> words{};         ///< that may be chosen; of `names` the keys that there are, if known
  std::vector<KeyType> parts{};             ///< elements of a list, entries of `names`, alternatives of `either`
  std::size_t least = 0, most = unlimited;  ///< length of a list
  const KeyTable& (*table)() = nullptr;     ///< rows of a table

  /// Itself, or the first alternative of that kind; null if there is none.
  const KeyType* as(Kind wanted) const;
};

/// The rows of { expr, unit }.
const KeyTable& expression_keys();
/// The rows of "kind" and "title", with which every case begins.
std::vector<Key> head_keys();

/// A value of the settings that a row sets.
struct KeyMember {
  void (*set)(const ConfigValue& value, void* settings) = nullptr;
  const void* settings_type = nullptr;  ///< tells the type of the settings
};

struct Key {
  std::string_view name;
  KeyType type;
  std::string otherwise;      ///< default, as it would stand in the file or in words; empty: the key is required
  std::string_view sentence;  ///< what it is, in about 20 words
  std::string_view only{};    ///< values of the table's deciding key, with blanks between, with which it is allowed
  KeyMember member{};         ///< where a reader does not ask for it by name
};

/// A table of the case file.
struct KeyTable {
  std::string_view name;  ///< as in "mesh.layers"
  std::string_view sentence;
  std::vector<Key> keys;
  std::string_view decided_by{};         ///< the key whose value decides which others there are
  std::string_view decided_otherwise{};  ///< its value where it is missing; empty: it is required
  bool decided_by_reader = false;        ///< the reader says with which of its values the keys are checked
};

/// Whether the row is there where the deciding key has the value `decided`.
bool is_there_with(const Key& key, std::string_view decided);

namespace keys {

KeyType text(std::string noun = "text");
KeyType path();
KeyType unit(const Dimension& due);  ///< "mm", alone
KeyType flag();
KeyType whole(const Range& allowed);
KeyType number(const Range& allowed = range::any);
KeyType quantity(const Dimension& due, const Range& allowed = range::any);
KeyType choice(std::string noun, std::initializer_list<std::string> words);
KeyType choice(std::string noun, std::vector<std::string> words);
KeyType list(KeyType element, std::size_t least = 0, std::size_t most = KeyType::unlimited);
KeyType table(const KeyTable& (*rows)());
KeyType tables(const KeyTable& (*rows)());                          ///< [[name]]
KeyType names(KeyType entry, std::vector<std::string> known = {});  ///< a table whose keys the user chooses
KeyType either(std::initializer_list<KeyType> alternatives);
KeyType anything();

KeyType point(const Range& allowed = range::any);  ///< three lengths
KeyType direction();                               ///< three numbers
/// Itself, or { expr, unit }, or a field out of a file (field_keys.h).
KeyType varying(const KeyType& plain);

/// The rows of several lists, in their order.
std::vector<Key> joined(std::initializer_list<std::vector<Key>> lists);

template <class Row>
std::vector<std::string> names_of(std::span<const Row> rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row.name);
  return names;
}
template <class Row>
KeyType one_of(std::string noun, std::span<const Row> rows) {
  return choice(std::move(noun), names_of(rows));
}

}  // namespace keys
}  // namespace pfdm
