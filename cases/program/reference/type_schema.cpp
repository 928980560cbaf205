#include "cases/program/reference/type_schema.h"

#include "cases/program/input/config/field_keys.h"
#include "cases/program/reference/table_schema.h"
#include "cases/program/reference/unit_patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;
using Kind = KeyType::Kind;

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

Json of_list(const SchemaTypes& lists) {
  SchemaTypes elements;
  std::size_t least = KeyType::unlimited, most = 0;
  for (const KeyType* list : lists) {
    elements.push_back(list->parts.data());
    least = std::min(least, list->least);
    most = std::max(most, list->most);
  }
  Json schema{{"type", "array"}, {"items", schema_of_types(elements)}};
  if (least > 0) schema["minItems"] = least;
  if (most != KeyType::unlimited) schema["maxItems"] = most;
  return schema;
}

Json of_names(const SchemaTypes& types) {
  SchemaTypes entries;
  for (const KeyType* type : types) entries.push_back(type->parts.data());
  Json schema{{"type", "object"}};
  const std::vector<std::string>& known = types.front()->words;
  if (known.empty()) {
    schema["additionalProperties"] = schema_of_types(entries);
    return schema;
  }
  for (const std::string& name : known) schema["properties"][name] = schema_of_types(entries);
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
                                                             : schema_of_types({&part}));
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
  Json schema = schema_of_tables({&expression_keys()});
  schema["properties"]["unit"]["pattern"] = "^\\s*" + unit_pattern(due) + "\\s*$";
  if (due.name != dimension::number.name) schema["required"] = {"expr", "unit"};
  return schema;
}

Json of_one(const KeyType& type) {
  if (const std::string name = definition_of(type); !name.empty()) return reference_to(name);
  switch (type.kind) {
    case Kind::text: return of_text(type);
    case Kind::boolean: return {{"type", "boolean"}};
    case Kind::whole: return of_whole(type);
    case Kind::choice: return {{"type", "string"}, {"enum", type.words}};
    case Kind::list: return of_list({&type});
    case Kind::table: return schema_of_tables({&type.table()});
    case Kind::names: return of_names({&type});
    case Kind::either: return of_alternatives(type);
    default: return Json::object();
  }
}

}  // namespace

Json schema_of_types(const SchemaTypes& all_types) {
  SchemaTypes types = all_types;
  if (types.size() > 1) std::erase_if(types, [](const KeyType* type) { return type->kind == Kind::anything; });
  const auto are_all = [&](Kind kind) {
    return std::ranges::all_of(types, [&](const KeyType* t) { return t->kind == kind; });
  };
  if (are_all(Kind::list)) return of_list(types);
  if (are_all(Kind::names)) return of_names(types);
  if (are_all(Kind::table)) {
    SchemaTables tables;
    for (const KeyType* type : types)
      if (std::ranges::count(tables, &type->table()) == 0) tables.push_back(&type->table());
    return tables.size() == 1 ? of_one(*types.front()) : schema_of_tables(tables);
  }
  std::vector<Json> all;
  for (const KeyType* type : types) all.push_back(of_one(*type));
  return any_of(all);
}

void add_definitions(const KeyType& type, Json& definitions) {
  if (const std::string name = definition_of(type); !name.empty())
    definitions[in_pointer(name)] = type.kind == Kind::quantity ? of_quantity(type)
                                    : type.kind == Kind::number ? of_number(type)
                                                                : schema_of_tables({&type.table()});
  if (type.kind == Kind::quantity) definitions[in_pointer(name_of_expression(*type.due))] = expression_of(*type.due);
  for (const KeyType& part : type.parts) add_definitions(part, definitions);
}

}  // namespace pfdm
