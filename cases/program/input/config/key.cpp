#include "cases/program/input/config/key.h"

#include "cases/program/input/config/field_keys.h"
#include "cases/program/input/config/kind_names.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pfdm {

const KeyType* KeyType::as(Kind wanted) const {
  if (kind == wanted) return this;
  if (kind != Kind::either) return nullptr;
  const auto found = std::ranges::find(parts, wanted, &KeyType::kind);
  return found == parts.end() ? nullptr : &*found;
}

bool is_there_with(const Key& key, std::string_view decided) {
  if (key.only.empty()) return true;
  for (std::size_t begin = 0; begin < key.only.size();) {
    const std::size_t end = std::min(key.only.find(' ', begin), key.only.size());
    if (key.only.substr(begin, end - begin) == decided) return true;
    begin = end + 1;
  }
  return false;
}

const KeyTable& expression_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "expression",
      .sentence = "A value as a formula in place of a plain one.",
      .keys = {
          {"expr", text("formula"), "",
           "Formula in x, y, z (metres), pi and, where the value may change with the load, t."},
          {"unit", text("unit"), "none", "Unit of the formula's value; required where the value has a dimension."},
      }};
  return table;
}

std::vector<Key> head_keys() {
  using namespace keys;
  return {{"kind", choice("kind of case", {std::begin(all_kind_names), std::end(all_kind_names)}), "",
           "Kind of the case, which decides what it computes and which keys there are."},
          {"title", text("line"), "", "Title of the case on one line, for lists, pages and results."}};
}

namespace keys {
using Kind = KeyType::Kind;

KeyType text(std::string noun) { return {.kind = Kind::text, .noun = std::move(noun)}; }
KeyType path() { return text("path"); }
KeyType unit(const Dimension& due) { return {.kind = Kind::text, .due = &due, .noun = "unit"}; }
KeyType flag() { return {.kind = Kind::boolean}; }
KeyType whole(const Range& allowed) { return {.kind = Kind::whole, .allowed = allowed}; }
KeyType number(const Range& allowed) { return {.kind = Kind::number, .allowed = allowed}; }

KeyType quantity(const Dimension& due, const Range& allowed) {
  return {.kind = Kind::quantity, .due = &due, .allowed = allowed};
}

KeyType choice(std::string noun, std::vector<std::string> words) {
  return {.kind = Kind::choice, .noun = std::move(noun), .words = std::move(words)};
}

KeyType choice(std::string noun, std::initializer_list<std::string> words) {
  return choice(std::move(noun), std::vector<std::string>(words));
}

KeyType list(KeyType element, std::size_t least, std::size_t most) {
  return {.kind = Kind::list, .parts = {std::move(element)}, .least = least, .most = most};
}

KeyType table(const KeyTable& (*rows)()) { return {.kind = Kind::table, .table = rows}; }
KeyType tables(const KeyTable& (*rows)()) { return list(table(rows)); }

KeyType names(KeyType entry, std::vector<std::string> known) {
  return {.kind = Kind::names, .words = std::move(known), .parts = {std::move(entry)}};
}

KeyType either(std::initializer_list<KeyType> alternatives) { return {.kind = Kind::either, .parts = alternatives}; }
KeyType anything() { return {}; }

KeyType point(const Range& allowed) { return list(quantity(dimension::length, allowed), 3, 3); }
KeyType direction() { return list(number(), 3, 3); }
KeyType varying(const KeyType& plain) { return either({plain, table(expression_keys), table(field_keys)}); }

std::vector<Key> joined(std::initializer_list<std::vector<Key>> lists) {
  std::vector<Key> all;
  for (const std::vector<Key>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace keys
}  // namespace pfdm
