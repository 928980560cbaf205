#pragma once
// Rows of keys that name the member of the settings which they set: such a key is one row and nothing else.

#include "cases/program/input/config/key.h"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <optional>
#include <stdexcept>
#include <string>

namespace pfdm {
namespace detail {

template <class Settings, class Value>
Settings settings_of(Value Settings::*);
template <class Settings, class Value>
Value value_of(Value Settings::*);

template <class Settings>
const void* type_of_settings() {
  static const char tag = 0;
  return &tag;
}

template <class T>
struct Plain {
  using type = T;
};
template <class T>
struct Plain<std::optional<T>> {
  using type = T;
};

template <class T>
T read_plain(const ConfigValue& value) {
  if constexpr (std::same_as<T, bool>)
    return value.boolean();
  else if constexpr (std::integral<T>)
    return static_cast<T>(value.integer());
  else if constexpr (std::floating_point<T>)
    return value.real();
  else
    return value.string();
}

/// As it would stand in the file; a limit that does not bind in words.
template <class T>
std::string shown_default(const T& value, const KeyType& type) {
  if constexpr (std::floating_point<T>) {
    if (std::isinf(value)) return "no limit";
    return type.due != nullptr ? fmt::format("\"{} {}\"", value, type.due->si_unit) : fmt::format("{}", value);
  } else if constexpr (std::same_as<T, std::string>) {
    return fmt::format("\"{}\"", value);
  } else if constexpr (std::same_as<T, bool> || std::integral<T>) {
    return fmt::format("{}", value);
  } else {
    return value ? shown_default(*value, type) : "none";
  }
}

}  // namespace detail

/// A key whose value goes to a member of the settings: bool, a whole number, a double [SI], a text, or one of these
/// that may be missing. Its default is that of the member, unless `otherwise` says it in words.
template <auto member>
Key stored(std::string_view name, KeyType type, std::string_view sentence, std::string otherwise = {}) {
  using Settings = decltype(detail::settings_of(member));
  using Value = decltype(detail::value_of(member));
  if (otherwise.empty()) otherwise = detail::shown_default(Settings{}.*member, type);
  const auto set = [](const ConfigValue& value, void* settings) {
    static_cast<Settings*>(settings)->*member = detail::read_plain<typename detail::Plain<Value>::type>(value);
  };
  return {.name = name,
          .type = std::move(type),
          .otherwise = std::move(otherwise),
          .sentence = sentence,
          .only = {},
          .member = {.set = set, .settings_type = detail::type_of_settings<Settings>()}};
}

/// Sets what the table says of the keys that rows store in such settings; the others keep their values.
template <class Settings>
void read_stored(const ConfigTable& table, Settings& settings) {
  for (const Key* key : table.rows())
    if (key->member.settings_type == detail::type_of_settings<Settings>())
      if (const auto value = table.find(key->name)) key->member.set(*value, &settings);
}

}  // namespace pfdm
