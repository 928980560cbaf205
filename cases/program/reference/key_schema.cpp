#include "cases/program/reference/key_schema.h"

#include "cases/program/reference/table_schema.h"
#include "cases/program/reference/type_schema.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

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
  SchemaTables roots;
  Json decisions = Json::array();
  for (const KindKeys& kind : kinds)
    for (const KeyTable* root : kind.roots) {
      roots.push_back(root);
      decisions.push_back(of_kind(kind.kind, *root));
    }
  Json schema{{"$schema", "http://json-schema.org/draft-04/schema#"},
              {"title", "case.toml of pfdm"},
              {"x-taplo-info", {{"patterns", {"case\\.toml$"}}}}};
  schema.update(schema_of_tables(roots));
  schema["description"] = "The input of a case; its kind decides which keys there are.";
  schema["anyOf"] = decisions;
  Json definitions = Json::object();
  for_each_key(kinds, [&](const PlacedKey& placed) { add_definitions(placed.key->type, definitions); });
  schema["definitions"] = definitions;
  return schema.dump(0) + "\n";
}

}  // namespace pfdm
