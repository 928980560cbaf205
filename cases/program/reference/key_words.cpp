#include "cases/program/reference/key_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

using Kind = KeyType::Kind;

std::string with_range(const std::string& what, const Range& allowed) {
  return allowed.words == range::any.words ? what : fmt::format("{}, {}", what, allowed.words);
}

std::string quoted(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) all.push_back(fmt::format("\"{}\"", word));
  return fmt::format("{}", fmt::join(all, ", "));
}

/// The names of the rows that a table may have, in braces.
std::string keys_in_braces(const KeyTable& table) {
  constexpr std::size_t shown = 6;
  std::vector<std::string_view> names;
  for (const Key& key : table.keys)
    if (std::find(names.begin(), names.end(), key.name) == names.end()) names.push_back(key.name);
  const bool more = names.size() > shown;
  if (more) names.resize(shown);
  return fmt::format("{{ {}{} }}", fmt::join(names, ", "), more ? " ..." : "");
}

std::string words_of_list(const KeyType& type) {
  const std::string element = words_of(type.parts.front());
  if (type.least == type.most) return fmt::format("list of {}: {}", type.least, element);
  if (type.most != KeyType::unlimited) return fmt::format("list of {} to {}: {}", type.least, type.most, element);
  return fmt::format("list of: {}", element);
}

std::string example_of(const KeyType& type);

std::string example_of_table(const KeyTable& table) {
  std::vector<std::string> entries;
  for (const Key& key : table.keys)
    if (key.otherwise.empty() && key.only.empty())
      entries.push_back(fmt::format("{} = {}", key.name, example_of(key.type)));
  if (entries.empty())
    entries.push_back(fmt::format("{} = {}", table.keys.front().name, example_of(table.keys.front().type)));
  return fmt::format("{{ {} }}", fmt::join(entries, ", "));
}

std::string example_number(const Range& allowed) {
  for (const double value : {0.3, 0.1, 1.0, 2.0, 20.0})
    if (allowed.holds(value)) return fmt::format("{}", value);
  return fmt::format("{}", allowed.least);
}

std::string example_of_list(const KeyType& type) {
  const std::size_t n = type.least == type.most ? type.least : 1;
  const std::vector<std::string> all(std::min<std::size_t>(n, 6), example_of(type.parts.front()));
  return fmt::format("[{}{}]", fmt::join(all, ", "), n > all.size() ? ", ..." : "");
}

std::string example_of(const KeyType& type) {
  switch (type.kind) {
    case Kind::text: return type.due != nullptr ? "\"mm\"" : fmt::format("\"{}\"", type.noun);
    case Kind::boolean: return "true";
    case Kind::whole: return type.allowed.holds(10.0) ? "10" : fmt::format("{:g}", type.allowed.least);
    case Kind::number: return example_number(type.allowed);
    case Kind::quantity: return fmt::format("\"{}\"", type.due->example);
    case Kind::choice: return fmt::format("\"{}\"", type.words.front());
    case Kind::list: return example_of_list(type);
    case Kind::table: return example_of_table(type.table());
    case Kind::names: return fmt::format("{{ NAME = {} }}", example_of(type.parts.front()));
    case Kind::either: return example_of(type.parts.front());
    case Kind::anything: return "...";
  }
  return "";
}

}  // namespace

std::string words_of(const KeyType& type) {
  switch (type.kind) {
    case Kind::text: return type.due != nullptr ? fmt::format("unit of a {}", type.due->name) : type.noun;
    case Kind::boolean: return "true or false";
    case Kind::whole: return with_range("whole number", type.allowed);
    case Kind::number: return with_range("number", type.allowed);
    case Kind::quantity: return with_range(fmt::format("{} (\"{}\")", type.due->name, type.due->example), type.allowed);
    case Kind::choice: return quoted(type.words);
    case Kind::list: return words_of_list(type);
    case Kind::table: return fmt::format("table {}", keys_in_braces(type.table()));
    case Kind::names: return fmt::format("table with names of your own: {}", words_of(type.parts.front()));
    case Kind::anything: return "anything";
    case Kind::either: {
      std::vector<std::string> all;
      for (const KeyType& part : type.parts) all.push_back(words_of(part));
      return fmt::format("{}", fmt::join(all, "; or "));
    }
  }
  return "";
}

std::string default_in_words(const Key& key) {
  if (key.otherwise.empty()) return "required";
  return key.otherwise.starts_with("or ") ? "required, " + key.otherwise : key.otherwise;
}

std::vector<std::string_view> one_of_which_is_required(const Key& key, const KeyTable& table) {
  std::vector<std::string_view> group{key.name};
  std::string_view rest = key.otherwise;
  while (rest.starts_with("or ")) {
    rest.remove_prefix(3);
    const std::string_view name = rest.substr(0, rest.find(' '));
    if (std::ranges::count(table.keys, name, &Key::name) == 0) return {};
    group.push_back(name);
    rest.remove_prefix(std::min(rest.size(), name.size() + 1));
  }
  return rest.empty() && group.size() > 1 ? group : std::vector<std::string_view>();
}

std::string example_line(const Key& key) { return fmt::format("{} = {}", key.name, example_of(key.type)); }

}  // namespace pfdm
