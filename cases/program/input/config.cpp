#include "cases/program/input/config.h"

#include "cases/program/input/key.h"
#include "cases/program/input/result_number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace pfdm {

struct ConfigSource {
  std::string file;
  TomlValue root;
  struct Opened {
    std::string path;
    std::set<std::string> asked_for;
    std::set<std::string> allowed;   // all keys, where they were named
    std::vector<const Key*> rows{};  // where the table has some
    const KeyType* entry = nullptr;  // of all keys, where the user chooses their names
    const std::set<std::string>& known() const { return allowed.empty() ? asked_for : allowed; }
  };
  std::map<const TomlTable*, Opened> opened;  // tables that were looked into
  std::vector<std::string> remarks;
};

namespace {

std::string table_place(const std::string& path) { return path.empty() ? "" : fmt::format("[{}] ", path); }

std::string place_of_key(const std::string& path, std::string_view key) {
  return fmt::format("{}{}", table_place(path), key);
}

std::string subtable(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

std::string said_at(const ConfigSource& source, int line, const std::string& message) {
  return fmt::format("{}:{}: {}", source.file, line, message);
}

InputError error_at(const ConfigSource& source, int line, const std::string& message) {
  return InputError(said_at(source, line, message));
}

void remark_at(ConfigSource& source, int line, const std::string& message) {
  std::string remark = said_at(source, line, message);
  if (std::ranges::count(source.remarks, remark) == 0) source.remarks.push_back(std::move(remark));
}

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

/// `list`: whether the keys that are known are all there are.
InputError unknown_key(const ConfigSource& source, const ConfigSource::Opened& table, const std::string& key, int line,
                       bool list) {
  const std::vector<std::string> known(table.known().begin(), table.known().end());
  const auto meant = nearest(key, known);
  return error_at(source, line,
                  fmt::format("{}\"{}\" is not known here{}{}", table_place(table.path), key,
                              meant ? fmt::format("; did you mean \"{}\"?", *meant) : "",
                              list ? fmt::format(" (allowed: {})", fmt::join(known, ", ")) : ""));
}

/// A key that nobody asked for.
InputError idle_key(const ConfigSource& source, const ConfigSource::Opened& table, const std::string& key, int line) {
  if (!table.allowed.contains(key)) return unknown_key(source, table, key, line, true);
  return error_at(
      source, line,
      fmt::format("{}\"{}\" has no effect with the other settings of this case", table_place(table.path), key));
}

void require_named(const ConfigSource::Opened& table, std::string_view key) {
  if (!table.known().contains(std::string(key)))
    throw std::logic_error(
        fmt::format("{}\"{}\" is asked for and not among the table's keys", table_place(table.path), key));
}

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

/// The alternative of a type that is of that kind. What asks for another kind than the row says is a mistake of the
/// program's.
const KeyType& due_of(const KeyType* type, KeyType::Kind kind, const std::string& place) {
  const KeyType* const due = type != nullptr ? type->as(kind) : nullptr;
  if (due == nullptr) throw std::logic_error(fmt::format("{}: its row says nothing of that kind", place));
  return *due;
}

/// Where the paths of a case start.
std::filesystem::path directory_of(const std::string& file) { return std::filesystem::path(file).parent_path(); }

void reject_unknown_in(const ConfigSource& source, const TomlValue& value) {
  if (const auto* array = std::get_if<TomlArray>(&value.value))
    for (const TomlValue& element : *array) reject_unknown_in(source, element);
  const auto* table = std::get_if<TomlTable>(&value.value);
  if (table == nullptr) return;
  const auto opened = source.opened.find(table);
  for (const auto& [key, entry] : *table) {
    if (opened != source.opened.end() && !opened->second.asked_for.contains(key))
      throw idle_key(source, opened->second, key, entry.key_line);
    reject_unknown_in(source, entry);
  }
}

}  // namespace

bool Range::holds(double value) const {
  if (!std::isfinite(value)) return false;
  return open ? least < value && value < most : least <= value && value <= most;
}

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

// ConfigValue

const std::string& ConfigValue::file() const { return source_->file; }

InputError ConfigValue::error(std::string_view message) const {
  return error_at(*source_, value_->line, fmt::format("{}: {}", place_, message));
}

void ConfigValue::remark(std::string_view message) const {
  remark_at(*source_, value_->line, fmt::format("{}: {}", place_, message));
}

std::string ConfigValue::string() const {
  if (const auto* text = std::get_if<std::string>(&value_->value)) return *text;
  throw error(fmt::format("expected a text in quotes, found {}", shown(*value_)));
}

std::string ConfigValue::line() const {
  std::string text = string();
  if (text.find_first_of("\n\r") != std::string::npos) throw error("expected a text of one line");
  return text;
}

bool ConfigValue::boolean() const {
  if (const bool* flag = std::get_if<bool>(&value_->value)) return *flag;
  throw error(fmt::format("expected true or false, found {}", shown(*value_)));
}

std::int64_t ConfigValue::integer(const Range& allowed) const {
  const auto* value = std::get_if<std::int64_t>(&value_->value);
  if (value == nullptr) throw error(fmt::format("expected a whole number, found {}", shown(*value_)));
  if (!allowed.holds(static_cast<double>(*value))) throw error(fmt::format("{} must be {}", *value, allowed.words));
  return *value;
}

double ConfigValue::number(const Range& allowed) const {
  double value = 0.0;
  if (path_of_result(*value_) != nullptr)
    value = in_context([&] { return result_number(*value_, directory_of(source_->file), dimension::number); });
  else if (const auto* real = std::get_if<double>(&value_->value))
    value = *real;
  else if (const auto* whole = std::get_if<std::int64_t>(&value_->value))
    value = static_cast<double>(*whole);
  else
    throw error(fmt::format("expected a number, found {}", shown(*value_)));
  if (!allowed.holds(value)) throw error(fmt::format("{} must be {}", value, allowed.words));
  return value;
}

std::string ConfigValue::shown_with_unit_due(const Dimension& due) const {
  const bool bare =
      std::holds_alternative<double>(value_->value) || std::holds_alternative<std::int64_t>(value_->value);
  return fmt::format("{} {}; expected {}, as in \"{}\"", shown(*value_), bare ? "has no unit" : "is not a quantity",
                     with_article(due.name), due.example);
}

double ConfigValue::quantity(const Dimension& due, const Range& allowed) const {
  const auto* text = std::get_if<std::string>(&value_->value);
  const bool from_results = path_of_result(*value_) != nullptr;
  if (text == nullptr && !from_results) throw error(shown_with_unit_due(due));
  const double value = in_context([&] {
    return from_results ? result_number(*value_, directory_of(source_->file), due) : parse_quantity(*text, due);
  });
  if (!allowed.holds(value)) throw error(fmt::format("{} must be {}", shown(*value_), allowed.words));
  return value;
}

std::int64_t ConfigValue::integer() const {
  return integer(type_ == nullptr ? range::any : due_of(type_, KeyType::Kind::whole, place_).allowed);
}

double ConfigValue::number() const {
  return number(type_ == nullptr ? range::any : due_of(type_, KeyType::Kind::number, place_).allowed);
}

double ConfigValue::quantity() const {
  const KeyType& due = due_of(type_, KeyType::Kind::quantity, place_);
  return quantity(*due.due, due.allowed);
}

double ConfigValue::real() const {
  return type_ != nullptr && type_->as(KeyType::Kind::quantity) != nullptr ? quantity() : number();
}

std::string ConfigValue::choice() const {
  const KeyType& due = due_of(type_, KeyType::Kind::choice, place_);
  return one_of(due.words, due.noun);
}

std::string ConfigValue::one_of(std::span<const std::string> allowed, std::string_view what) const {
  std::string value = string();
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
  const auto meant = nearest(value, allowed);
  throw error(fmt::format("\"{}\" is not {}{} (allowed: {})", value, with_article(what),
                          meant ? fmt::format("; did you mean \"{}\"?", *meant) : "", fmt::join(allowed, ", ")));
}

std::vector<ConfigValue> ConfigValue::list(std::optional<std::size_t> n) const {
  const auto* array = std::get_if<TomlArray>(&value_->value);
  if (array == nullptr) throw error(fmt::format("expected a list, found {}", shown(*value_)));
  if (n && array->size() != *n) throw error(fmt::format("expected {} entries, found {}", *n, array->size()));
  std::vector<ConfigValue> result;
  const KeyType* const type = type_ != nullptr ? type_->as(KeyType::Kind::list) : nullptr;
  for (std::size_t i = 0; i < array->size(); ++i)
    result.emplace_back(source_, &(*array)[i], fmt::format("{}[{}]", place_, i), path_,
                        type != nullptr ? type->parts.data() : nullptr);
  return result;
}

ConfigTable ConfigValue::table() const {
  if (!is_table()) throw error(fmt::format("expected a table, found {}", shown(*value_)));
  ConfigTable table(source_, value_, path_);
  if (type_ == nullptr) return table;
  if (type_->kind == KeyType::Kind::table) return table.with_keys(type_->table());
  if (type_->kind == KeyType::Kind::names)
    source_->opened[&std::get<TomlTable>(value_->value)].entry = type_->parts.data();
  return table;
}

// ConfigTable

ConfigTable::ConfigTable(std::shared_ptr<ConfigSource> source, const TomlValue* value, std::string path)
    : source_(std::move(source)), value_(value), path_(std::move(path)) {
  source_->opened[&content()].path = path_;
}

InputError ConfigTable::error(std::string_view message) const {
  return error_at(*source_, value_->line, fmt::format("{}{}", table_place(path_), message));
}

void ConfigTable::remark(std::string_view message) const {
  remark_at(*source_, value_->line, fmt::format("{}{}", table_place(path_), message));
}

ConfigTable ConfigTable::with_keys(std::span<const std::string_view> keys) const {
  ConfigSource::Opened& opened = source_->opened[&content()];
  if (!opened.allowed.empty()) {
    for (const std::string_view key : keys) require_named(opened, key);
    return *this;
  }
  opened.allowed = opened.asked_for;
  opened.allowed.insert(keys.begin(), keys.end());
  for (const auto& [name, value] : content())
    if (!opened.allowed.contains(name)) throw unknown_key(*source_, opened, name, value.key_line, true);
  return *this;
}

ConfigTable ConfigTable::with_keys(const KeyTable& rows, std::optional<std::string_view> decided) const {
  ConfigSource::Opened& opened = source_->opened[&content()];
  const bool is_open = !decided && rows.decided_by_reader;  // until the reader says which keys there are
  const std::optional<std::string> found = decided   ? std::optional(std::string(*decided))
                                           : is_open ? std::nullopt
                                                     : decided_in(content(), rows);
  opened.rows.clear();
  std::vector<std::string_view> names;
  for (const Key& key : rows.keys) {
    if (found && !is_there_with(key, *found)) continue;
    opened.rows.push_back(&key);
    names.push_back(key.name);
  }
  return found ? with_keys(names) : *this;
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
  require_named(opened, key);
  for (const auto& [name, value] : content())
    if (name == key) return ConfigValue(source_, &value, place_of_key(path_, key), subtable(path_, key), type_of(key));
  return std::nullopt;
}

bool ConfigTable::has(std::string_view key) const { return find(key).has_value(); }

/// A missing key is often a misspelt one.
InputError ConfigTable::missing(std::string_view key, std::string_view what) const {
  const ConfigSource::Opened& opened = source_->opened[&content()];
  const std::string wanted[] = {std::string(key)};
  for (const auto& [name, value] : content())
    if (!opened.known().contains(name) && nearest(name, wanted))
      return unknown_key(*source_, opened, name, value.key_line, false);  // others may be asked for later
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
  return required(key, fmt::format("; expected a table [{}]", subtable(path_, key))).table();
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
  return required_quantity(key, *due_of(type_of(key), KeyType::Kind::quantity, place_of_key(path_, key)).due)
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

// Config

Config::Config(const std::string& text, std::string shown_as) : source_(std::make_shared<ConfigSource>()) {
  source_->file = std::move(shown_as);
  source_->root = parse_toml(text, source_->file);
}

ConfigTable Config::root() const { return ConfigTable(source_, &source_->root, ""); }

const std::vector<std::string>& Config::remarks() const { return source_->remarks; }

void Config::reject_unknown_keys() const { reject_unknown_in(*source_, source_->root); }

}  // namespace pfdm
