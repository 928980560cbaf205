#include "cases/program/reference/key_help.h"

#include "cases/program/reference/key_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace pfdm {
namespace {

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::string part;
  for (std::size_t i = 0; i <= path.size(); ++i) {
    if (i < path.size() && path[i] != '.' && path[i] != '[') {
      part += path[i];
      continue;
    }
    if (!part.empty() && part != "NAME") parts.push_back(part);
    part.clear();
    if (i < path.size() && path[i] == '[') i = std::min(path.find(']', i), path.size() - 1);
  }
  return parts;
}

/// Whether the words stand in the path in their order, the last at its end; others may stand between, as a material's
/// name does, whichever it is.
bool is_meant(const std::vector<std::string>& asked, const PlacedKey& placed) {
  const std::vector<std::string> path = parts_of(placed.path);
  if (asked.empty() || asked.back() != path.back()) return false;
  std::size_t found = 0;
  for (const std::string& part : path)
    if (found < asked.size() && part == asked[found]) ++found;
  if (found == asked.size()) return true;
  // materials.steel.poisson_ratio: a word in the place of NAME
  const std::size_t name = placed.path.find(".NAME");
  if (name == std::string::npos || asked.size() < 3) return false;
  std::vector<std::string> without = asked;
  without.erase(without.begin() + 1);
  return is_meant(without, placed);
}

/// One row and the places where it stands.
struct Entry {
  const Key* key;
  const KeyTable* table;
  std::vector<std::string> places;
};

/// Rows that say the same count as one.
bool are_alike(const Key& a, const Key& b) {
  return a.name == b.name && a.sentence == b.sentence && a.otherwise == b.otherwise &&
         words_of(a.type) == words_of(b.type);
}

std::string decided_words(const Entry& entry) {
  if (entry.key->only.empty()) return "";
  const std::string_view by = entry.table->decided_by.empty() ? "a kind" : entry.table->decided_by;
  return fmt::format("  only with  {}: {}\n", by, entry.key->only);
}

std::string text_of(const Entry& entry) {
  return fmt::format("{}\n  {}\n  value      {}\n  default    {}\n{}  in         {}\n  example    {}\n",
                     entry.key->name, entry.key->sentence, words_of(entry.key->type), default_in_words(*entry.key),
                     decided_words(entry), fmt::join(entry.places, "\n             "), example_line(*entry.key));
}

void add(std::vector<Entry>& entries, const PlacedKey& placed) {
  const std::string place = fmt::format("{} ({})", placed.path, placed.kind);
  auto entry = std::ranges::find_if(entries, [&](const Entry& e) { return are_alike(*e.key, *placed.key); });
  if (entry == entries.end()) entry = entries.insert(entries.end(), {placed.key, placed.table, {}});
  if (std::ranges::count(entry->places, place) == 0) entry->places.push_back(place);
}

}  // namespace

std::optional<std::string> help_on_key(const std::string& asked, const std::vector<KindKeys>& kinds) {
  const std::vector<std::string> words = parts_of(asked);
  std::vector<Entry> entries;
  for_each_key(kinds, [&](const PlacedKey& placed) {
    if (is_meant(words, placed)) add(entries, placed);
  });
  if (entries.empty()) return std::nullopt;
  std::vector<std::string> texts;
  for (const Entry& entry : entries) texts.push_back(text_of(entry));
  return fmt::format("{}", fmt::join(texts, "\n"));
}

std::vector<std::string> keys_like(const std::string& asked, const std::vector<KindKeys>& kinds) {
  const std::vector<std::string> words = parts_of(asked);
  std::set<std::string> names;
  for_each_key(kinds, [&](const PlacedKey& placed) { names.insert(std::string(placed.key->name)); });
  const std::string word = words.empty() ? asked : words.back();
  std::vector<std::string> all(names.begin(), names.end()), found;
  while (const auto near = nearest(word, all)) {
    found.push_back(*near);
    std::erase(all, *near);
    if (found.size() == 3) break;
  }
  for (const std::string& name : all)
    if (found.size() < 6 && word.size() > 3 && name.find(word) != std::string::npos) found.push_back(name);
  return found;
}

}  // namespace pfdm
