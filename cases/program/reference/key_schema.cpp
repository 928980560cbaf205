#include "cases/program/reference/key_schema.h"

#include "cases/program/reference/key_words.h"
#include "cases/program/reference/unit_patterns.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;
using Kind = KeyType::Kind;
using Types = std::vector<const KeyType*>;
using Tables = std::vector<const KeyTable*>;

Json of_types(const Types& types);
Json of_tables(const Tables& tables);

/// { from, key, unit }: a number out of a result file.
void add_result_number(Json& schema, const char* plain) {
  schema["type"] = {plain, "object"};
  schema["properties"] = {
      {"from", {{"type", "string"}}}, {"key", {{"type", "string"}}}, {"unit", {{"type", "string"}}}};
  schema["required"] = {"from", "key"};
  schema["additionalProperties"] = false;
}

void add_limits(Json& schema, const Range& allowed) {
  if (std::isfinite(allowed.least)) {
    schema["minimum"] = allowed.least;
    if (allowed.open) schema["exclusiveMinimum"] = true;
  }
  if (std::isfinite(allowed.most)) {
    schema["maximum"] = allowed.most;
    if (allowed.open) schema["exclusiveMaximum"] = true;
  }
}

Json of_list(const Types& lists) {
  Types elements;
  std::size_t least = KeyType::unlimited, most = 0;
  for (const KeyType* list : lists) {
    elements.push_back(list->parts.data());
    least = std::min(least, list->least);
    most = std::max(most, list->most);
  }
  Json schema{{"type", "array"}, {"items", of_types(elements)}};
  if (least > 0) schema["minItems"] = least;
  if (most != KeyType::unlimited) schema["maxItems"] = most;
  return schema;
}

Json of_names(const Types& types) {
  Types entries;
  for (const KeyType* type : types) entries.push_back(type->parts.data());
  Json schema{{"type", "object"}};
  const std::vector<std::string>& known = types.front()->words;
  if (known.empty()) {
    schema["additionalProperties"] = of_types(entries);
    return schema;
  }
  for (const std::string& name : known) schema["properties"][name] = of_types(entries);
  schema["additionalProperties"] = false;
  return schema;
}

Json any_of(const std::vector<Json>& alternatives) {
  std::vector<Json> distinct;
  for (const Json& one : alternatives)
    if (std::ranges::count(distinct, one) == 0) distinct.push_back(one);
  return distinct.size() == 1 ? distinct.front() : Json{{"anyOf", distinct}};
}

Json of_alternatives(const KeyType& type) {
  std::vector<Json> all;
  for (const KeyType& part : type.parts) all.push_back(of_types({&part}));
  return any_of(all);
}

Json of_text(const KeyType& type) {
  Json schema{{"type", "string"}};
  if (type.due != nullptr) schema["pattern"] = "^\\s*" + unit_pattern(*type.due) + "\\s*$";
  return schema;
}

Json of_number(const KeyType& type) {
  Json schema;
  add_result_number(schema, "number");
  add_limits(schema, type.allowed);
  return schema;
}

Json of_whole(const KeyType& type) {
  Json schema{{"type", "integer"}};
  add_limits(schema, type.allowed);
  return schema;
}

Json of_quantity(const KeyType& type) {
  Json schema;
  add_result_number(schema, "string");
  schema["pattern"] = quantity_pattern(*type.due, type.allowed);
  return schema;
}

Json of_one(const KeyType& type) {
  switch (type.kind) {
    case Kind::text: return of_text(type);
    case Kind::boolean: return {{"type", "boolean"}};
    case Kind::whole: return of_whole(type);
    case Kind::number: return of_number(type);
    case Kind::quantity: return of_quantity(type);
    case Kind::choice: return {{"type", "string"}, {"enum", type.words}};
    case Kind::list: return of_list({&type});
    case Kind::table: return of_tables({&type.table()});
    case Kind::names: return of_names({&type});
    case Kind::either: return of_alternatives(type);
    case Kind::anything: return Json::object();
  }
  return Json::object();
}

/// Of one key in tables that share a place: such tables become one, so that an editor marks the line that is wrong.
Json of_types(const Types& types) {
  const auto are_all = [&](Kind kind) {
    return std::ranges::all_of(types, [&](const KeyType* t) { return t->kind == kind; });
  };
  if (are_all(Kind::list)) return of_list(types);
  if (are_all(Kind::names)) return of_names(types);
  if (are_all(Kind::table)) {
    Tables tables;
    for (const KeyType* type : types) tables.push_back(&type->table());
    return of_tables(tables);
  }
  std::vector<Json> all;
  for (const KeyType* type : types) all.push_back(of_one(*type));
  return any_of(all);
}

std::string description_of(const Key& key) {
  return fmt::format("{}\n\n{}\n\nDefault: {}", key.sentence, words_of(key.type), default_in_words(key));
}

/// Whether the key has to stand in every one of the tables.
bool is_required(std::string_view name, const Tables& tables) {
  return std::ranges::all_of(tables, [&](const KeyTable* table) {
    return std::ranges::any_of(
        table->keys, [&](const Key& key) { return key.name == name && key.otherwise.empty() && key.only.empty(); });
  });
}

/// Which keys there are, and have to be, with one value of the key that decides it.
Json with_decided(const KeyTable& table, const std::string& word) {
  Json schema{{"properties", {{std::string(table.decided_by), {{"enum", {word}}}}}}};
  Json required = Json::array();
  if (word != table.decided_otherwise) required.push_back(table.decided_by);
  for (const Key& key : table.keys) {
    if (!is_there_with(key, word)) continue;
    if (key.name != table.decided_by) schema["properties"][std::string(key.name)] = Json::object();
    if (key.otherwise.empty() && key.name != table.decided_by) required.push_back(key.name);
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

void add_decisions(const KeyTable& table, Json& schema) {
  if (table.decided_by.empty() || table.decided_by_reader) return;
  const auto row = std::ranges::find(table.keys, table.decided_by, &Key::name);
  for (const std::string& word : row->type.as(Kind::choice)->words)
    schema["anyOf"].push_back(with_decided(table, word));
}

Json of_tables(const Tables& tables) {
  Json schema{{"type", "object"}, {"description", tables.front()->sentence}, {"properties", Json::object()}};
  std::vector<std::string_view> names;
  for (const KeyTable* table : tables)
    for (const Key& key : table->keys)
      if (std::ranges::count(names, key.name) == 0) names.push_back(key.name);
  Json required = Json::array();
  for (const std::string_view name : names) {
    Types types;
    std::vector<std::string> descriptions;
    for (const KeyTable* table : tables)
      for (const Key& key : table->keys)
        if (key.name == name) {
          types.push_back(&key.type);
          if (std::ranges::count(descriptions, description_of(key)) == 0) descriptions.push_back(description_of(key));
        }
    Json property = of_types(types);
    property["description"] = descriptions.front();
    for (std::size_t i = 1; i < descriptions.size(); ++i)
      property["description"] = property["description"].get<std::string>() + "\n\n---\n\n" + descriptions[i];
    schema["properties"][std::string(name)] = property;
    if (is_required(name, tables)) required.push_back(name);
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  if (tables.size() == 1) add_decisions(*tables.front(), schema);
  return schema;
}

/// Which tables a file of a kind has.
Json of_kind(const std::string_view kind, const KeyTable& root) {
  Json schema{{"properties", {{"kind", {{"enum", {kind}}}}}}};
  Json required = Json::array();
  for (const Key& key : root.keys) {
    if (key.name != "kind") schema["properties"][std::string(key.name)] = Json::object();
    if (key.otherwise.empty()) required.push_back(key.name);
  }
  schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

std::string key_schema(const std::vector<KindKeys>& kinds) {
  Tables roots;
  Json decisions = Json::array();
  for (const KindKeys& kind : kinds)
    for (const KeyTable* root : kind.roots) {
      roots.push_back(root);
      decisions.push_back(of_kind(kind.kind, *root));
    }
  Json schema{{"$schema", "http://json-schema.org/draft-04/schema#"},
              {"title", "case.toml of pfdm"},
              {"x-taplo-info", {{"patterns", {"case\\.toml$"}}}}};
  schema.update(of_tables(roots));
  schema["description"] = "The input of a case; its kind decides which keys there are.";
  schema["anyOf"] = decisions;
  return schema.dump(1) + "\n";
}

}  // namespace pfdm
