#include "cases/program/reference/table_schema.h"

#include "cases/program/reference/key_words.h"
#include "cases/program/reference/type_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;
using Kind = KeyType::Kind;

std::string description_of(const Key& key) {
  return fmt::format("{}\n\n{}\n\nDefault: {}", key.sentence, words_of(key.type), default_in_words(key));
}

/// Whether the key has to stand in every one of the tables.
bool is_required(std::string_view name, const SchemaTables& tables) {
  return std::ranges::all_of(tables, [&](const KeyTable* table) {
    return std::ranges::any_of(
        table->keys, [&](const Key& key) { return key.name == name && key.otherwise.empty() && key.only.empty(); });
  });
}

/// Of some keys just one has to be there.
void add_groups(const KeyTable& table, const std::function<bool(const Key&)>& is_there, Json& schema) {
  std::vector<std::set<std::string_view>> seen;
  for (const Key& key : table.keys) {
    const std::vector<std::string_view> group = one_of_which_is_required(key, table);
    const std::set<std::string_view> names(group.begin(), group.end());
    if (group.empty() || !is_there(key) || std::ranges::count(seen, names) > 0) continue;
    seen.push_back(names);
    Json choices = Json::array();
    for (const std::string_view name : names) choices.push_back({{"required", {name}}});
    schema["allOf"].push_back({{"oneOf", choices}});
  }
}

/// Which keys there are, and have to be, with some values of the key that decides it.
Json with_decided(const KeyTable& table, const std::vector<std::string_view>& words, bool may_be_missing) {
  Json schema{{"properties", {{std::string(table.decided_by), {{"enum", words}}}}}};
  const auto is_there = [&](const Key& key) {
    return std::ranges::any_of(words, [&](std::string_view word) { return is_there_with(key, word); });
  };
  Json required = Json::array();
  if (!may_be_missing) required.push_back(table.decided_by);
  for (const Key& key : table.keys) {
    if (!is_there(key) || key.name == table.decided_by) continue;
    schema["properties"][std::string(key.name)] = Json::object();
    if (key.otherwise.empty() && (words.size() == 1 || key.only.empty())) required.push_back(key.name);
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  add_groups(table, is_there, schema);
  return schema;
}

void add_decisions(const KeyTable& table, Json& schema) {
  if (table.decided_by.empty())
    return add_groups(
        table, [](const Key& key) { return key.only.empty(); }, schema);
  const auto row = std::ranges::find(table.keys, table.decided_by, &Key::name);
  const std::vector<std::string>& words = row->type.as(Kind::choice)->words;
  for (const std::string& word : words)
    schema["anyOf"].push_back(with_decided(table, {word}, word == table.decided_otherwise));
  if (!table.decided_by_reader) return;
  // What a missing word stands for is not known here.
  const Json is_missing{{"not", {{"required", {table.decided_by}}}}};
  schema["anyOf"].push_back({{"allOf", {with_decided(table, {words.begin(), words.end()}, true), is_missing}}});
}

/// Which keys one of several tables at a place has, and has to have.
Json shape_of(const KeyTable& table) {
  Json schema{{"properties", Json::object()}};
  for (const Key& key : table.keys) schema["properties"][std::string(key.name)] = Json::object();
  Json required = Json::array();
  for (const auto& [name, anything] : schema["properties"].items())
    if (is_required(name, {&table})) required.push_back(name);
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  add_decisions(table, schema);
  return schema;
}

/// What is said of a key by one name in several tables.
Json property_of(std::string_view name, const SchemaTables& tables) {
  SchemaTypes types;
  std::vector<std::string> descriptions;
  for (const KeyTable* table : tables)
    for (const Key& key : table->keys) {
      if (key.name != name) continue;
      types.push_back(&key.type);
      if (std::ranges::count(descriptions, description_of(key)) == 0) descriptions.push_back(description_of(key));
    }
  Json property = schema_of_types(types);
  if (property.contains("$ref")) property = {{"allOf", Json::array({property})}};  // nothing may stand beside $ref
  property["description"] = fmt::format("{}", fmt::join(descriptions, "\n\n---\n\n"));
  return property;
}

}  // namespace

Json schema_of_tables(const SchemaTables& tables) {
  Json schema{{"type", "object"}, {"description", tables.front()->sentence}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const KeyTable* table : tables)
    for (const Key& key : table->keys) {
      if (schema["properties"].contains(std::string(key.name))) continue;
      schema["properties"][std::string(key.name)] = property_of(key.name, tables);
      if (is_required(key.name, tables)) required.push_back(key.name);
    }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  if (tables.size() == 1)
    add_decisions(*tables.front(), schema);
  else
    for (const KeyTable* table : tables) schema["anyOf"].push_back(shape_of(*table));
  return schema;
}

}  // namespace pfdm
