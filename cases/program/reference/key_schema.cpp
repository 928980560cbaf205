#include "cases/program/reference/key_schema.h"

#include "cases/program/input/config/field_keys.h"
#include "cases/program/reference/key_words.h"
#include "cases/program/reference/unit_patterns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

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

std::string in_pointer(const std::string& name) {
  std::string word;
  for (const char c : name) word += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' ? c : '_';
  return word;
}

Json reference_to(const std::string& name) { return {{"$ref", "#/definitions/" + in_pointer(name)}}; }

std::string name_of_expression(const Dimension& due) { return fmt::format("expression of {}", due.name); }

bool is_expression(const KeyType& type) { return type.kind == Kind::table && &type.table() == &expression_keys(); }

/// Beside a quantity an expression has a unit, which has to be of its dimension.
Json of_alternatives(const KeyType& type) {
  const KeyType* const quantity = type.as(Kind::quantity);
  std::vector<Json> all;
  for (const KeyType& part : type.parts)
    all.push_back(is_expression(part) && quantity != nullptr ? reference_to(name_of_expression(*quantity->due))
                                                             : of_types({&part}));
  return any_of(all);
}

/// Of texts that may not be any.
constexpr std::pair<std::string_view, std::string_view> text_patterns[] = {
    {"line", "^[^\\n\\r]*$"},
    {"plain name", "^[A-Za-z0-9_-][A-Za-z0-9_.-]*$"},
    {"date", "^[0-9]{4}-[0-9]{2}-[0-9]{2}$"},
    {"amount of memory", "^[0-9]{1,9} ?[MGT]B$"},
};

Json of_text(const KeyType& type) {
  Json schema{{"type", "string"}};
  for (const auto& [noun, pattern] : text_patterns)
    if (type.noun == noun) schema["pattern"] = pattern;
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

/// The name of what stands once among the definitions, as it is the same for many keys; empty for all else.
std::string definition_of(const KeyType& type) {
  const std::string range = type.allowed.words == range::any.words ? "" : fmt::format(", {}", type.allowed.words);
  if (type.kind == Kind::quantity) return std::string(type.due->name) + range;
  if (type.kind == Kind::number) return "number" + range;
  if (type.kind == Kind::table && (&type.table() == &expression_keys() || &type.table() == &field_keys()))
    return std::string(type.table().name);
  return "";
}

Json expression_of(const Dimension& due) {
  Json schema = of_tables({&expression_keys()});
  schema["properties"]["unit"]["pattern"] = "^\\s*" + unit_pattern(due) + "\\s*$";
  if (due.name != dimension::number.name) schema["required"] = {"expr", "unit"};
  return schema;
}

void add_definitions(const KeyType& type, Json& definitions) {
  if (const std::string name = definition_of(type); !name.empty())
    definitions[in_pointer(name)] = type.kind == Kind::quantity ? of_quantity(type)
                                    : type.kind == Kind::number ? of_number(type)
                                                                : of_tables({&type.table()});
  if (type.kind == Kind::quantity) definitions[in_pointer(name_of_expression(*type.due))] = expression_of(*type.due);
  for (const KeyType& part : type.parts) add_definitions(part, definitions);
}

Json of_one(const KeyType& type) {
  if (const std::string name = definition_of(type); !name.empty()) return reference_to(name);
  switch (type.kind) {
    case Kind::text: return of_text(type);
    case Kind::boolean: return {{"type", "boolean"}};
    case Kind::whole: return of_whole(type);
    case Kind::choice: return {{"type", "string"}, {"enum", type.words}};
    case Kind::list: return of_list({&type});
    case Kind::table: return of_tables({&type.table()});
    case Kind::names: return of_names({&type});
    case Kind::either: return of_alternatives(type);
    default: return Json::object();
  }
}

/// Of one key in tables that share a place: such tables become one, so that an editor marks the line that is wrong.
Json of_types(const Types& all_types) {
  Types types = all_types;
  if (types.size() > 1) std::erase_if(types, [](const KeyType* type) { return type->kind == Kind::anything; });
  const auto are_all = [&](Kind kind) {
    return std::ranges::all_of(types, [&](const KeyType* t) { return t->kind == kind; });
  };
  if (are_all(Kind::list)) return of_list(types);
  if (are_all(Kind::names)) return of_names(types);
  if (are_all(Kind::table)) {
    Tables tables;
    for (const KeyType* type : types)
      if (std::ranges::count(tables, &type->table()) == 0) tables.push_back(&type->table());
    return tables.size() == 1 ? of_one(*types.front()) : of_tables(tables);
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
Json property_of(std::string_view name, const Tables& tables) {
  Types types;
  std::vector<std::string> descriptions;
  for (const KeyTable* table : tables)
    for (const Key& key : table->keys) {
      if (key.name != name) continue;
      types.push_back(&key.type);
      if (std::ranges::count(descriptions, description_of(key)) == 0) descriptions.push_back(description_of(key));
    }
  Json property = of_types(types);
  if (property.contains("$ref")) property = {{"allOf", Json::array({property})}};  // nothing may stand beside $ref
  property["description"] = fmt::format("{}", fmt::join(descriptions, "\n\n---\n\n"));
  return property;
}

Json of_tables(const Tables& tables) {
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
  Json definitions = Json::object();
  for_each_key(kinds, [&](const PlacedKey& placed) { add_definitions(placed.key->type, definitions); });
  schema["definitions"] = definitions;
  return schema.dump(0) + "\n";
}

}  // namespace pfdm
