#include "cases/program/input/config/config.h"

#include "cases/program/input/config/config_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace pfdm {
namespace {

/// The word that decides which rows a table has; nothing where it is missing or none of those that there are.
std::optional<std::string> decided_in(const TomlTable& content, const KeyTable& rows) {
  if (rows.decided_by.empty()) return "";
  const auto row = std::ranges::find(rows.keys, rows.decided_by, &Key::name);
  const KeyType* const choice = row->type.as(KeyType::Kind::choice);
  for (const auto& [key, value] : content) {
    if (key != rows.decided_by) continue;
    const auto* text = std::get_if<std::string>(&value.value);
    return text != nullptr && std::ranges::count(choice->words, *text) > 0 ? std::optional(*text) : std::nullopt;
  }
  return rows.decided_otherwise.empty() ? std::nullopt : std::optional(std::string(rows.decided_otherwise));
}

}  // namespace

ConfigTable::ConfigTable(std::shared_ptr<ConfigSource> source, const TomlValue* value, std::string path)
    : source_(std::move(source)), value_(value), path_(std::move(path)) {
  source_->opened[&content()].path = path_;
}

InputError ConfigTable::error(std::string_view message) const {
  return source_->error_at(value_->line, fmt::format("{}{}", ConfigSource::place_of_table(path_), message));
}

void ConfigTable::remark(std::string_view message) const {
  source_->remark_at(value_->line, fmt::format("{}{}", ConfigSource::place_of_table(path_), message));
}

ConfigTable ConfigTable::with_keys(std::span<const std::string_view> keys) const {
  ConfigSource::Opened& opened = source_->opened[&content()];
  if (!opened.allowed.empty()) {
    for (const std::string_view key : keys) opened.require_named(key);
    return *this;
  }
  opened.allowed = opened.asked_for;
  opened.allowed.insert(keys.begin(), keys.end());
  for (const auto& [name, value] : content())
    if (!opened.allowed.contains(name)) throw source_->unknown_key(opened, name, value.key_line, true);
  return *this;
}

ConfigTable ConfigTable::with_keys(const KeyTable& rows, std::optional<std::string_view> decided) const {
  ConfigSource::Opened& opened = source_->opened[&content()];
  const bool is_open = !decided && rows.decided_by_reader;  // until the reader says which keys there are
  const std::optional<std::string> found = decided   ? std::optional(std::string(*decided))
                                           : is_open ? std::nullopt
                                                     : decided_in(content(), rows);
  opened.rows.clear();
  if (found && opened.allowed.empty()) source_->refuse_keys_of_others(opened, content(), rows, *found);
  std::vector<std::string_view> names;
  for (const Key& key : rows.keys) {
    if (found && !is_there_with(key, *found)) continue;
    opened.rows.push_back(&key);
    names.push_back(key.name);
  }
  return found ? with_keys(names) : *this;
}

void ConfigTable::refuse_keys_beyond(const KeyTable& there, const KeyTable& with, std::string_view need) const {
  const auto has = [](const KeyTable& rows, const std::string& name) {
    return std::ranges::find(rows.keys, name, &Key::name) != rows.keys.end();
  };
  for (const auto& [name, value] : content())
    if (has(with, name) && !has(there, name))
      throw source_->error_at(value.key_line,
                              fmt::format("{}\"{}\" is not known here: it goes with {}, which is not given",
                                          ConfigSource::place_of_table(path_), name, need));
}

std::vector<const Key*> ConfigTable::rows() const { return source_->opened[&content()].rows; }

const KeyType* ConfigTable::type_of(std::string_view key) const {
  const ConfigSource::Opened& opened = source_->opened[&content()];
  if (opened.entry != nullptr) return opened.entry;
  const auto row = std::ranges::find(opened.rows, key, &Key::name);
  return row == opened.rows.end() ? nullptr : &(*row)->type;
}

std::optional<ConfigValue> ConfigTable::find(std::string_view key) const {
  ConfigSource::Opened& opened = source_->opened[&content()];
  opened.asked_for.emplace(key);
  opened.require_named(key);
  for (const auto& [name, value] : content())
    if (name == key)
      return ConfigValue(source_, &value, ConfigSource::place_of_key(path_, key), ConfigSource::subtable(path_, key),
                         type_of(key));
  return std::nullopt;
}

bool ConfigTable::has(std::string_view key) const { return find(key).has_value(); }

/// A missing key is often a misspelt one.
InputError ConfigTable::missing(std::string_view key, std::string_view what) const {
  const ConfigSource::Opened& opened = source_->opened[&content()];
  const std::string wanted[] = {std::string(key)};
  for (const auto& [name, value] : content())
    if (!opened.known().contains(name) && nearest(name, wanted))
      return source_->unknown_key(opened, name, value.key_line, false);  // others may be asked for later
  return error(fmt::format("\"{}\" is missing{}", key, what));
}

ConfigValue ConfigTable::required(std::string_view key, std::string_view what) const {
  if (auto value = find(key)) return *value;
  throw missing(key, what);
}

ConfigValue ConfigTable::at(std::string_view key) const { return required(key, ""); }

std::vector<std::pair<std::string, ConfigValue>> ConfigTable::entries() const {
  std::vector<std::pair<std::string, ConfigValue>> result;
  for (const auto& [name, value] : content()) result.emplace_back(name, *find(name));
  return result;
}

ConfigTable ConfigTable::table(std::string_view key) const {
  return required(key, fmt::format("; expected a table [{}]", ConfigSource::subtable(path_, key))).table();
}

std::string ConfigTable::string(std::string_view key, std::string_view otherwise) const {
  const auto value = find(key);
  return value ? value->string() : std::string(otherwise);
}

bool ConfigTable::boolean(std::string_view key, bool otherwise) const {
  const auto value = find(key);
  return value ? value->boolean() : otherwise;
}

std::int64_t ConfigTable::integer(std::string_view key, const Range& allowed, std::int64_t otherwise) const {
  const auto value = find(key);
  return value ? value->integer(allowed) : otherwise;
}

double ConfigTable::number(std::string_view key, const Range& allowed, double otherwise) const {
  const auto value = find(key);
  return value ? value->number(allowed) : otherwise;
}

std::int64_t ConfigTable::integer(std::string_view key, std::int64_t otherwise) const {
  const auto value = find(key);
  return value ? value->integer() : otherwise;
}

double ConfigTable::number(std::string_view key, double otherwise) const {
  const auto value = find(key);
  return value ? value->number() : otherwise;
}

std::string ConfigTable::choice(std::string_view key, std::string_view otherwise) const {
  const auto value = find(key);
  return value ? value->choice() : std::string(otherwise);
}

ConfigValue ConfigTable::required_quantity(std::string_view key, const Dimension& due) const {
  return required(key, fmt::format("; expected {}, as in \"{}\"", with_article(due.name), due.example));
}

double ConfigTable::quantity(std::string_view key, const Dimension& due, const Range& allowed) const {
  return required_quantity(key, due).quantity(due, allowed);
}

double ConfigTable::quantity(std::string_view key) const {
  return required_quantity(key,
                           *due_of(type_of(key), KeyType::Kind::quantity, ConfigSource::place_of_key(path_, key)).due)
      .quantity();
}

double ConfigTable::quantity(std::string_view key, double otherwise) const {
  const auto value = find(key);
  return value ? value->quantity() : otherwise;
}

double ConfigTable::quantity(std::string_view key, const Dimension& due, const Range& allowed, double otherwise) const {
  const auto value = find(key);
  return value ? value->quantity(due, allowed) : otherwise;
}

std::vector<std::string> ConfigTable::strings(std::string_view key) const {
  std::vector<std::string> result;
  for (const ConfigValue& value : at(key).list()) result.push_back(value.string());
  return result;
}

std::vector<ConfigTable> ConfigTable::tables(std::string_view key) const {
  std::vector<ConfigTable> result;
  if (const auto value = find(key))
    for (const ConfigValue& element : value->list()) result.push_back(element.table());
  return result;
}

Config::Config(const std::string& text, std::string shown_as, BareNumbers numbers, std::vector<int> lines)
    : source_(std::make_shared<ConfigSource>()) {
  source_->lines = std::move(lines);
  source_->numbers = numbers;
  source_->file = std::move(shown_as);
  source_->root = parse_toml(text, source_->file);
}

ConfigTable Config::root() const { return ConfigTable(source_, &source_->root, ""); }

const std::vector<std::string>& Config::remarks() const { return source_->remarks; }

void Config::reject_unknown_keys() const { source_->reject_unknown_keys(); }

std::vector<GivenKey> Config::given_keys() const { return source_->given_keys(); }

}  // namespace pfdm
