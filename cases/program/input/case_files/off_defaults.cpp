#include "cases/program/input/case_files/off_defaults.h"

#include "cases/program/input/config/key.h"
#include "physics/error.h"
#include "postproc/files/utf8.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

namespace pfdm {
namespace {

constexpr std::size_t longest = 200;  // characters of a value

bool is_required(std::string_view otherwise) {
  return otherwise.empty() || otherwise.starts_with("or ") || otherwise.starts_with("required") ||
         otherwise.starts_with("none: required");
}

/// The value that a default in TOML has; nothing of one in words.
std::optional<TomlValue> parsed(const std::string& otherwise) {
  const std::size_t end = otherwise.find(": ");  // "0: none" says what the value means
  try {
    return value_at(parse_toml("value = " + otherwise.substr(0, end), "default"), "value");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// In SI, if it is a number or may be a quantity of that dimension.
std::optional<double> number_in(const TomlValue& value, const KeyType& type) {
  if (const auto* number = std::get_if<double>(&value.value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return static_cast<double>(*whole);
  const auto* text = std::get_if<std::string>(&value.value);
  const KeyType* const quantity = type.as(KeyType::Kind::quantity);
  if (text == nullptr || quantity == nullptr) return std::nullopt;
  try {
    return parse_quantity(*text, *quantity->due);
  } catch (const InputError&) {  // a word, as "free"
    return std::nullopt;
  }
}

bool are_same(const TomlValue& a, const TomlValue& b, const KeyType& type) {
  const auto *list = std::get_if<TomlArray>(&a.value), *other = std::get_if<TomlArray>(&b.value);
  if (list != nullptr && other != nullptr && type.kind == KeyType::Kind::list) {
    bool same = list->size() == other->size();
    for (std::size_t i = 0; same && i < list->size(); ++i) same = are_same((*list)[i], (*other)[i], type.parts.front());
    return same;
  }
  constexpr double rounding = 1e-12;  // of two units
  const std::optional<double> x = number_in(a, type), y = number_in(b, type);
  if (x && y) return std::abs(*x - *y) <= rounding * std::abs(*x);
  return written(a) == written(b);
}

/// Without needless zeros in the exponent.
std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (const std::size_t at = text.find('e'); at != std::string::npos && text[at + 2] == '0') text.erase(at + 2, 1);
  return text;
}

/// As TOML has it.
std::string as_text(const TomlValue& value) {
  if (const auto* text = std::get_if<std::string>(&value.value)) return quoted_toml(*text);
  std::vector<std::string> parts;
  if (const auto* array = std::get_if<TomlArray>(&value.value)) {
    for (const TomlValue& element : *array) parts.push_back(as_text(element));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const auto* table = std::get_if<TomlTable>(&value.value)) {
    for (const auto& [key, entry] : *table) parts.push_back(fmt::format("{} = {}", key, as_text(entry)));
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  if (const auto* number = std::get_if<double>(&value.value)) return number_text(*number);
  return written(value);
}

/// Not within a character of several bytes.
std::string cut(std::string text) {
  if (text.size() <= longest) return text;
  return text.substr(0, utf8_border(text, longest)) + " ...";
}

}  // namespace

std::vector<OffDefault> off_defaults(const Config& config) {
  std::vector<OffDefault> found;
  for (const GivenKey& given : config.given_keys()) {
    const std::string& otherwise = given.row->otherwise;
    if (is_required(otherwise)) continue;
    const std::optional<TomlValue> value = parsed(otherwise);
    if (value && are_same(*given.value, *value, given.row->type)) continue;
    found.push_back({.path = given.path, .value = cut(as_text(*given.value)), .otherwise = otherwise});
  }
  return found;
}

}  // namespace pfdm
