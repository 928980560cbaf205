#include "cases/program/reference/key_search.h"

#include "cases/program/reference/key_help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace pfdm {
namespace {

/// A row, and one of the places where it stands: "fracture.length".
struct FoundKey {
  const Key* key;
  std::string place;
  std::string_view kind;
  std::size_t n_places = 1;
};

constexpr std::size_t most_lines = 12;

std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool is_plural(const std::string& many, const std::string& one) { return one.back() != 's' && many == one + "s"; }

/// Whether a word of a key is one that is asked for.
using Match = bool (*)(const std::string& of_key, const std::string& asked);

bool is_same(const std::string& of_key, const std::string& asked) {
  return of_key == asked || is_plural(of_key, asked) || is_plural(asked, of_key);
}

bool begins_alike(const std::string& of_key, const std::string& asked) {
  constexpr std::size_t least = 4;
  return asked.size() >= least && of_key.starts_with(asked);
}

bool has_all(const std::vector<std::string>& words, const std::vector<std::string>& asked, Match matches) {
  return std::ranges::all_of(asked, [&](const std::string& word) {
    return std::ranges::any_of(words, [&](const std::string& w) { return matches(w, word); });
  });
}

void add(const PlacedKey& placed, std::vector<FoundKey>& found) {
  const auto known = std::ranges::find_if(found, [&](const FoundKey& other) {
    return other.key->name == placed.key->name && other.key->sentence == placed.key->sentence;
  });
  if (known != found.end())
    ++known->n_places;
  else
    found.push_back({placed.key, placed.path, placed.kind});
}

void append(std::vector<std::string>& words, const std::vector<std::string>& others) {
  words.insert(words.end(), others.begin(), others.end());
}

void add_words_of_values(const KeyType& type, std::vector<std::string>& words) {
  for (const std::string& value : type.words) append(words, words_in(value));
  for (const KeyType& part : type.parts) add_words_of_values(part, words);
}

/// Those with the words in their name first, then in name and sentence, then in their values and in those with which
/// they are allowed. Keys whose name is `asked` are left out.
std::vector<FoundKey> keys_about(const std::string& asked, const std::vector<KindKeys>& kinds, Match matches) {
  const std::vector<std::string> words = words_in(asked);
  std::vector<FoundKey> by_name, by_sentence, by_value;
  if (words.empty()) return {};
  for_each_key(kinds, [&](const PlacedKey& placed) {
    if (placed.key->name == asked) return;
    std::vector<std::string> all = words_in(placed.key->name);
    if (has_all(all, words, matches)) return add(placed, by_name);
    append(all, words_in(placed.key->sentence));
    if (has_all(all, words, matches)) return add(placed, by_sentence);
    add_words_of_values(placed.key->type, all);
    if (has_all(all, words, matches)) return add(placed, by_value);
    append(all, words_in(placed.key->only));
    if (has_all(all, words, matches)) add(placed, by_value);
  });
  by_name.insert(by_name.end(), by_sentence.begin(), by_sentence.end());
  by_name.insert(by_name.end(), by_value.begin(), by_value.end());
  return by_name;
}

/// Those whose name and sentence have most of several words, of three letters or more.
std::vector<FoundKey> keys_about_most(const std::string& asked, const std::vector<KindKeys>& kinds) {
  std::vector<std::string> words = words_in(asked);
  std::erase_if(words, [](const std::string& word) { return word.size() < 3; });
  std::vector<FoundKey> found;
  std::ptrdiff_t most = 1;
  for_each_key(kinds, [&](const PlacedKey& placed) {
    std::vector<std::string> all = words_in(placed.key->name);
    append(all, words_in(placed.key->sentence));
    const auto n = std::ranges::count_if(words, [&](const std::string& word) { return has_all(all, {word}, is_same); });
    if (n < most) return;
    if (n > most) found.clear();
    most = n;
    add(placed, found);
  });
  return found;
}

std::string text_of(const std::vector<FoundKey>& found) {
  std::string text;
  for (std::size_t i = 0; i < std::min(found.size(), most_lines); ++i) {
    const FoundKey& at = found[i];
    const std::string others = at.n_places > 1 ? fmt::format(" and {} more", at.n_places - 1) : "";
    text +=
        fmt::format("{}\n  {}\n  in         {} ({}){}\n", at.key->name, at.key->sentence, at.place, at.kind, others);
  }
  if (found.size() > most_lines) text += fmt::format("and {} more\n", found.size() - most_lines);
  return text;
}

std::string places_of(const std::vector<FoundKey>& found) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < std::min(found.size(), most_lines); ++i) places.push_back(found[i].place);
  return fmt::format("{}{}", fmt::join(places, ", "), found.size() > most_lines ? " ..." : "");
}

/// Of a word that names no key of the first kind, the first few of its keys that tell of it; else nothing.
std::string of_first_kind(const std::string& asked, const std::vector<KindKeys>& kinds) {
  constexpr std::size_t few = 3;
  const std::vector<KindKeys> first{kinds.front()};
  std::vector<FoundKey> about = keys_about(asked, first, is_same);
  if (help_on_key(asked, first) || about.empty()) return {};
  about.resize(std::min(few, about.size()));
  return fmt::format("keys of {} cases that tell of it:\n\n{}\nkeys with that name:\n\n", first.front().kind,
                     text_of(about));
}

}  // namespace

std::optional<std::string> help_on_word(const std::string& asked, const std::vector<KindKeys>& kinds) {
  std::vector<FoundKey> about = keys_about(asked, kinds, is_same);
  if (const auto text = help_on_key(asked, kinds))
    return about.empty() ? *text
                         : fmt::format("{}{}\nothers that tell of it: {}\n", of_first_kind(asked, kinds), *text,
                                       places_of(about));
  if (about.empty()) about = keys_about(asked, kinds, begins_alike);
  if (about.empty()) about = keys_about_most(asked, kinds);
  if (about.empty()) return std::nullopt;
  return fmt::format("no key has the name \"{}\"; these tell of it:\n\n{}", asked, text_of(about));
}

bool tells_of(std::string_view text, std::string_view asked) {
  const std::vector<std::string> words = words_in(asked);
  return !words.empty() && has_all(words_in(text), words, is_same);
}

std::vector<std::string> names_of_keys(const std::vector<KindKeys>& kinds) {
  std::set<std::string> names;
  for_each_key(kinds, [&](const PlacedKey& placed) { names.insert(std::string(placed.key->name)); });
  return {names.begin(), names.end()};
}

}  // namespace pfdm
