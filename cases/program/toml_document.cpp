#include "cases/program/toml_document.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace pfdm {
namespace {

int line_of(const toml::source_region& source) { return static_cast<int>(source.begin.line); }

TomlValue plain(const toml::node& node, const std::string& file);

TomlArray plain_array(const toml::array& array, const std::string& file) {
  TomlArray result;
  for (const toml::node& element : array) result.push_back(plain(element, file));
  return result;
}

TomlTable plain_table(const toml::table& table, const std::string& file) {
  TomlTable result;
  for (const auto& [key, node] : table) {
    result.emplace_back(std::string(key.str()), plain(node, file));
    result.back().second.key_line = line_of(key.source());
  }
  // toml++ keeps them by name.
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.second.key_line < b.second.key_line; });
  return result;
}

TomlValue plain(const toml::node& node, const std::string& file) {
  TomlValue result;
  result.line = result.key_line = line_of(node.source());
  if (const auto* table = node.as_table())
    result.value = plain_table(*table, file);
  else if (const auto* array = node.as_array())
    result.value = plain_array(*array, file);
  else if (const auto* text = node.as_string())
    result.value = text->get();
  else if (const auto* flag = node.as_boolean())
    result.value = flag->get();
  else if (const auto* integer = node.as_integer())
    result.value = integer->get();
  else if (const auto* number = node.as_floating_point())
    result.value = number->get();
  else
    throw InputError(fmt::format("{}:{}: dates and times have no meaning here", file, result.line));
  return result;
}

}  // namespace

TomlValue parse_toml(const std::string& text, const std::string& shown_as) {
  try {
    return plain(toml::parse(text), shown_as);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", shown_as, line_of(error.source()), error.description()));
  }
}

std::string written(const TomlValue& value) {
  struct Write {
    std::string operator()(const TomlArray& array) const {
      std::string text = "[";
      for (const TomlValue& element : array) text += written(element) + ",";
      return text + "]";
    }
    std::string operator()(const TomlTable& table) const {
      std::string text = "{";
      for (const auto& [key, entry] : table) text += fmt::format("\"{}\"={},", key, written(entry));
      return text + "}";
    }
    std::string operator()(const std::string& text) const { return fmt::format("\"{}\"", text); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
  };
  return std::visit(Write{}, value.value);
}

std::string shown(const TomlValue& value) {
  struct Show {
    std::string operator()(const std::string& text) const { return fmt::format("\"{}\"", text); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const TomlArray& array) const { return fmt::format("a list of {}", array.size()); }
    std::string operator()(const TomlTable&) const { return "a table"; }
  };
  return std::visit(Show{}, value.value);
}

}  // namespace pfdm
