#include "cases/program/reference/key_tree.h"

namespace pfdm {
namespace {

void add_tables(const KeyType& type, const std::string& way, std::vector<SubTable>& found) {
  if (type.table != nullptr) found.push_back({&type.table(), way});
  const std::string further = type.kind == KeyType::Kind::list    ? "[]"
                              : type.kind == KeyType::Kind::names ? ".NAME"
                                                                  : "";
  for (const KeyType& part : type.parts) add_tables(part, way + further, found);
}

void walk(std::string_view kind, const KeyTable& table, const std::string& path,
          const std::function<void(const PlacedKey&)>& see) {
  for (const Key& key : table.keys) {
    const std::string here = path.empty() ? std::string(key.name) : path + "." + std::string(key.name);
    see({kind, here, &table, &key});
    for (const SubTable& below : tables_below(key.type)) walk(kind, *below.rows, here + below.way, see);
  }
}

}  // namespace

std::vector<SubTable> tables_below(const KeyType& type) {
  std::vector<SubTable> found;
  add_tables(type, "", found);
  return found;
}

void for_each_key(const std::vector<KindKeys>& kinds, const std::function<void(const PlacedKey&)>& see) {
  for (const KindKeys& kind : kinds)
    for (const KeyTable* root : kind.roots) walk(kind.kind, *root, "", see);
}

}  // namespace pfdm
