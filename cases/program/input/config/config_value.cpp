#include "cases/program/input/config/config_value.h"

#include "cases/program/input/config/config_source.h"
#include "cases/program/input/config/result_number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

/// Where the paths of a case start.
std::filesystem::path directory_of(const std::string& file) { return std::filesystem::path(file).parent_path(); }

/// Of a number without a unit.
std::optional<double> bare_number(const TomlValue& value) {
  if (const auto* real = std::get_if<double>(&value.value)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return static_cast<double>(*whole);
  return std::nullopt;
}

}  // namespace

bool Range::holds(double value) const {
  if (!std::isfinite(value)) return false;
  return open ? least < value && value < most : least <= value && value <= most;
}

const std::string& ConfigValue::file() const { return source_->file; }

InputError ConfigValue::error(std::string_view message) const {
  return source_->error_at(value_->line, fmt::format("{}: {}", place_, message));
}

void ConfigValue::remark(std::string_view message) const {
  source_->remark_at(value_->line, fmt::format("{}: {}", place_, message));
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
  else if (const auto bare = bare_number(*value_))
    value = *bare;
  else
    throw error(fmt::format("expected a number, found {}", shown(*value_)));
  if (!allowed.holds(value)) throw error(fmt::format("{} must be {}", value, allowed.words));
  return value;
}

std::string ConfigValue::shown_with_unit_due(const Dimension& due) const {
  return fmt::format("{} {}; expected {}, as in \"{}\"", shown(*value_),
                     bare_number(*value_) ? "has no unit" : "is not a quantity", with_article(due.name), due.example);
}

double ConfigValue::quantity(const Dimension& due, const Range& allowed) const {
  const auto* text = std::get_if<std::string>(&value_->value);
  const bool from_results = path_of_result(*value_) != nullptr;
  const auto in_si = source_->numbers == BareNumbers::in_si ? bare_number(*value_) : std::nullopt;
  if (text == nullptr && !from_results && !in_si) throw error(shown_with_unit_due(due));
  const double value = in_context([&] {
    if (in_si) return *in_si;
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
  throw error(fmt::format("\"{}\" is not {}{} (allowed: {})", value, with_article(what), did_you_mean(value, allowed),
                          fmt::join(allowed, ", ")));
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

}  // namespace pfdm
