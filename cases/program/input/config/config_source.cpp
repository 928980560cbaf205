#include "cases/program/input/config/config_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace pfdm {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// Other names of what may be chosen, in small letters and digits.
struct OtherName {
  std::string_view words, value;
};
constexpr OtherName other_names[] = {{"pfczm", "Wu"},
                                     {"czm", "Wu"},
                                     {"cohesive", "Wu"},
                                     {"amor", "volumetric_deviatoric"},
                                     {"voldev", "volumetric_deviatoric"},
                                     {"miehe", "spectral"},
                                     {"notension", "no_tension"},
                                     {"bourdin", "AT2"},
                                     {"standard", "AT2"},
                                     {"ambati", "hybrid"}};

/// What stands among the candidates under another name.
std::optional<std::string> known_as(std::string_view word, std::span<const std::string> candidates) {
  std::string plain;
  for (const char c : word)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const OtherName& other : other_names)
    if (plain == other.words && std::ranges::count(candidates, other.value) > 0) return std::string(other.value);
  return std::nullopt;
}

/// Whether nothing but tables may stand there, alone, in a list or under names.
bool is_of_tables(const KeyType& type) {
  using enum KeyType::Kind;
  return type.kind == table || ((type.kind == list || type.kind == names) && is_of_tables(type.parts.front()));
}

/// Adds the keys of the tables in `value`, which stands at `path`.
void add_given(const ConfigSource& source, const TomlValue& value, const std::string& path,
               std::vector<GivenKey>& given) {
  if (const auto* array = std::get_if<TomlArray>(&value.value))
    for (std::size_t i = 0; i < array->size(); ++i)
      add_given(source, (*array)[i], fmt::format("{}[{}]", path, i), given);
  const auto* table = std::get_if<TomlTable>(&value.value);
  const auto looked_into = source.opened.find(table);
  if (table == nullptr || looked_into == source.opened.end()) return;
  const std::vector<const Key*>& rows = looked_into->second.rows;
  for (const auto& [name, entry] : *table) {
    const auto row = std::ranges::find(rows, name, &Key::name);
    const std::string below = ConfigSource::subtable(path, name);
    if (row != rows.end() && !is_of_tables((*row)->type))
      given.push_back({.path = below, .row = *row, .value = &entry});
    else
      add_given(source, entry, below, given);
  }
}

}  // namespace

std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates) {
  std::optional<std::string> best;
  std::size_t smallest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates)
    if (const std::size_t distance = edit_distance(word, candidate);
        distance < smallest && distance < candidate.size()) {
      smallest = distance;
      best = candidate;
    }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  auto near = known_as(word, candidates);
  if (!near) near = nearest(word, candidates);
  return near ? fmt::format("; did you mean \"{}\"?", *near) : "";
}

void ConfigSource::Opened::require_named(std::string_view key) const {
  if (!known().contains(std::string(key)))
    throw std::logic_error(fmt::format("{}\"{}\" is asked for and not among the table's keys", place(), key));
}

std::string ConfigSource::place_of_table(const std::string& path) {
  return path.empty() ? "" : fmt::format("[{}] ", path);
}

std::string ConfigSource::place_of_key(const std::string& path, std::string_view key) {
  return fmt::format("{}{}", place_of_table(path), key);
}

std::string ConfigSource::subtable(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

std::string ConfigSource::said_at(int line, const std::string& message) const {
  if (numbers == BareNumbers::in_si) return fmt::format("{}: {}", file, message);  // values of a script have no lines
  if (!lines.empty() && line > 0 && static_cast<std::size_t>(line) <= lines.size())
    line = lines[static_cast<std::size_t>(line) - 1];
  return line > 0 ? fmt::format("{}:{}: {}", file, line, message) : fmt::format("{}: {}", file, message);
}

InputError ConfigSource::error_at(int line, const std::string& message) const {
  return InputError(said_at(line, message));
}

void ConfigSource::remark_at(int line, const std::string& message) {
  std::string remark = said_at(line, message);
  if (std::ranges::count(remarks, remark) == 0) remarks.push_back(std::move(remark));
}

InputError ConfigSource::unknown_key(const Opened& table, const std::string& key, int line, bool list) const {
  const std::vector<std::string> known(table.known().begin(), table.known().end());
  return error_at(line, fmt::format("{}\"{}\" is not known here{}{}", table.place(), key, did_you_mean(key, known),
                                    list ? fmt::format(" (allowed: {})", fmt::join(known, ", ")) : ""));
}

void ConfigSource::refuse_keys_of_others(const Opened& table, const TomlTable& content, const KeyTable& rows,
                                         std::string_view decided) const {
  if (rows.decided_by.empty()) return;
  for (const auto& [name, value] : content) {
    std::string with;
    bool is_there = table.asked_for.contains(name);
    for (const Key& key : rows.keys) {
      if (key.name != name) continue;
      is_there = is_there || is_there_with(key, decided);
      with += fmt::format("{}{}", with.empty() ? "" : " ", key.only);
    }
    if (is_there || with.empty()) continue;
    for (std::size_t at = with.find(' '); at != std::string::npos; at = with.find(' ', at + 4))
      with.replace(at, 1, "\", \"");
    const bool says = std::ranges::count(content, rows.decided_by, &TomlEntry::key) > 0;
    throw error_at(value.key_line, fmt::format("{}\"{}\" is not known here: it belongs to {} = \"{}\"{}", table.place(),
                                               name, rows.decided_by, with,
                                               says ? fmt::format(", not \"{}\"", decided) : ", which is not given"));
  }
}

InputError ConfigSource::idle_key(const Opened& table, const std::string& key, int line) const {
  if (!table.allowed.contains(key)) return unknown_key(table, key, line, true);
  return error_at(line, fmt::format("{}\"{}\" has no effect with the other settings of this case", table.place(), key));
}

void ConfigSource::reject_unknown_in(const TomlValue& value) const {
  if (const auto* array = std::get_if<TomlArray>(&value.value))
    for (const TomlValue& element : *array) reject_unknown_in(element);
  const auto* table = std::get_if<TomlTable>(&value.value);
  if (table == nullptr) return;
  const auto looked_into = opened.find(table);
  for (const auto& [key, entry] : *table) {
    if (looked_into != opened.end() && !looked_into->second.asked_for.contains(key))
      throw idle_key(looked_into->second, key, entry.key_line);
    reject_unknown_in(entry);
  }
}

std::vector<GivenKey> ConfigSource::given_keys() const {
  std::vector<GivenKey> given;
  add_given(*this, root, "", given);
  return given;
}

const KeyType& due_of(const KeyType* type, KeyType::Kind kind, const std::string& place) {
  const KeyType* const due = type != nullptr ? type->as(kind) : nullptr;
  if (due == nullptr) throw std::logic_error(fmt::format("{}: its row says nothing of that kind", place));
  return *due;
}

}  // namespace pfdm
