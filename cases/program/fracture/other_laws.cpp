#include "cases/program/fracture/other_laws.h"

#include "cases/program/fracture/body/interface_reader.h"
#include "physics/damage/softening_law.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace pfdm {
namespace {

/// The text at a key, if there is one.
const std::string* text_at(const TomlValue& root, const std::string& key) {
  try {
    return std::get_if<std::string>(&value_at(root, key).value);
  } catch (const InputError&) {
    return nullptr;
  }
}

/// `keys`: values of the file that all are `now`.
template <class Laws>
void add_others(const CaseFile& file, const std::vector<std::string>& keys, const std::string& now, const Laws& laws,
                std::vector<CaseVariant>& variants) {
  for (const auto& law : laws) {
    if (law.name == now) continue;
    std::string text = file.text;
    for (const std::string& key : keys) text = with_value(text, key, fmt::format("\"{}\"", law.name));
    variants.push_back(
        {with_text(file, std::move(text)), fmt::format("{} = \"{}\" in place of \"{}\"", keys.front(), law.name, now)});
  }
}

std::vector<std::string> interfaces_like_the_first(const TomlValue& root) {
  std::vector<std::string> keys;
  const std::string* first = nullptr;
  for (int i = 0;; ++i) {
    const std::string key = fmt::format("interface[{}].law", i);
    const std::string* const law = text_at(root, key);
    if (law == nullptr) return keys;
    if (first == nullptr) first = law;
    if (*law == *first) keys.push_back(key);
  }
}

}  // namespace

std::vector<CaseVariant> with_other_laws(const CaseFile& file) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  std::vector<CaseVariant> variants;
  if (const std::string* softening = text_at(root, "fracture.softening"))
    add_others(file, {"fracture.softening"}, *softening, softening_laws(), variants);
  if (const std::vector<std::string> keys = interfaces_like_the_first(root); !keys.empty())
    add_others(file, keys, *text_at(root, keys.front()), interface_laws(), variants);
  return variants;
}

}  // namespace pfdm
