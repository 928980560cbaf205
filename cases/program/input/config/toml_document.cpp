#include "cases/program/input/config/toml_document.h"

#include "cases/program/input/config/key_depth.h"
#include "physics/error.h"
#include "postproc/files/text_file.h"
#include "postproc/files/utf8.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <utility>

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
  // toml++ keeps them by name.
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::ranges::stable_sort(entries, {}, [](const auto& entry) {
    const toml::source_position& begin = entry.first->source().begin;
    return std::pair(begin.line, begin.column);
  });
  TomlTable result;
  for (const auto& [key, node] : entries) {
    result.push_back({std::string(key->str()), plain(*node, file)});
    result.back().value.key_line = line_of(key->source());
  }
  return result;
}

TomlValue plain(const toml::node& node, const std::string& file) {
  TomlValue result;
  result.line = result.key_line = line_of(node.source());
  result.column = static_cast<int>(node.source().begin.column);
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
    throw InputError(fmt::format("{}:{}: dates and times are not supported", file, result.line));
  return result;
}

/// What a path names next: a key, or the number of an element.
struct Step {
  std::string_view key;
  std::optional<int> element;
};

Step take_step(std::string_view& path) {
  if (path.starts_with('[')) {
    const std::size_t end = path.find(']');
    const auto number = end == std::string_view::npos ? std::nullopt : parse_int(path.substr(1, end - 1));
    if (!number) throw InputError(fmt::format("\"{}\" is not the number of an element, as in [0]", path));
    path.remove_prefix(end + 1);
    return {{}, number};
  }
  if (path.starts_with('.')) path.remove_prefix(1);
  const std::size_t end = std::min(path.find_first_of(".["), path.size());
  const Step step{path.substr(0, end), std::nullopt};
  path.remove_prefix(end);
  return step;
}

const TomlValue& element_of(const TomlValue& list, int number, std::string_view where) {
  const auto* array = std::get_if<TomlArray>(&list.value);
  if (array == nullptr) throw InputError(fmt::format("\"{}\" is not a list", where));
  if (number < 0 || static_cast<std::size_t>(number) >= array->size())
    throw InputError(fmt::format("\"{}\" has {} elements, of which the first is [0]; there is no [{}]", where,
                                 array->size(), number));
  return (*array)[number];
}

const TomlValue& entry_of(const TomlValue& value, std::string_view key, std::string_view where) {
  const auto* table = std::get_if<TomlTable>(&value.value);
  if (table == nullptr) throw InputError(fmt::format("\"{}\" is not a table", where));
  std::vector<std::string> keys;
  for (const auto& [name, entry] : *table) {
    if (name == key) return entry;
    keys.push_back(name);
  }
  throw InputError(fmt::format("{} has no \"{}\" (available: {})",
                               where.empty() ? std::string("the case") : fmt::format("[{}]", where), key,
                               fmt::join(keys, ", ")));
}

/// Where the character of this line and column begins.
std::size_t offset_of(const std::string& text, int line, int column) {
  std::size_t at = 0;
  for (int l = 1; l < line; ++l) at = text.find('\n', at) + 1;
  for (int c = 1; c < column; ++c)
    for (++at; at < text.size() && utf8_continues(text[at]);) ++at;
  return at;
}

/// How long the text or number is that stands at `at`.
std::size_t length_of_scalar(const std::string& text, std::size_t at) {
  const char first = text[at];
  if (first != '"' && first != '\'') return std::min(text.find_first_of(" \t\r\n,]}#", at), text.size()) - at;
  return end_of_string(text, at) - at;
}

/// How long the list or table is whose bracket or brace opens at `at`.
std::size_t length_in_brackets(const std::string& text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < text.size(); ++i) {
    if (text[i] == '"' || text[i] == '\'') i = end_of_string(text, i) - 1;
    if (text[i] == '#') i = std::min(text.find('\n', i), text.size() - 1);
    if (text[i] == '[' || text[i] == '{') ++depth;
    if ((text[i] == ']' || text[i] == '}') && --depth == 0) return i + 1 - at;
  }
  return text.size() - at;
}

/// Whether a list stands in brackets, not below lines as [[boundary]].
bool is_in_brackets(const std::string& text, std::size_t at) {
  const std::size_t line = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
  const bool is_header =
      text.compare(at, 2, "[[") == 0 && trimmed(std::string_view(text).substr(line, at - line)).empty();
  return at < text.size() && text[at] == '[' && !is_header;
}

/// Why a table, or a list, does not get a value that is no list, and what can be set of it.
std::string words_for_what_has_parts(const TomlValue& old, std::string_view path, bool in_brackets) {
  if (std::holds_alternative<TomlTable>(old.value)) {
    std::string below(path);  // the first key of it that is no table
    const TomlValue* at = &old;
    for (const auto* table = &std::get<TomlTable>(old.value); table != nullptr && !table->empty();
         table = std::get_if<TomlTable>(&at->value)) {
      below += "." + table->front().key;
      at = &table->front().value;
    }
    return fmt::format("\"{}\" is a table; its keys can be set{}", path, at == &old ? "" : ", as " + below);
  }
  if (in_brackets) return fmt::format("\"{}\" is a list: expected one, as [...]", path);
  const auto& list = std::get<TomlArray>(old.value);
  const auto& first = std::get<TomlTable>(list.front().value);  // [[path]]
  return fmt::format("\"{0}\" is a list of {1} table{2}; {3}tables are added and taken away in the file", path,
                     list.size(), list.size() == 1 ? "" : "s",
                     first.empty() ? "" : fmt::format("their keys can be set, as {}[0].{}; ", path, first.front().key));
}

}  // namespace

const TomlValue& value_at(const TomlValue& root, std::string_view path) {
  const TomlValue* value = &root;
  std::string_view rest = path;
  while (!rest.empty() || value == &root) {
    const std::string_view where = path.substr(0, path.size() - rest.size());
    const Step step = take_step(rest);
    value = step.element ? &element_of(*value, *step.element, where) : &entry_of(*value, step.key, where);
  }
  return *value;
}

std::string with_value(const std::string& text, std::string_view path, const std::string& value) {
  const TomlValue root = parse_toml(text, "case.toml");
  const TomlValue& old = value_at(root, path);
  const std::size_t at = offset_of(text, old.line, old.column);
  const bool in_brackets = std::holds_alternative<TomlArray>(old.value) && is_in_brackets(text, at);
  const bool in_braces = std::holds_alternative<TomlTable>(old.value) && at < text.size() && text[at] == '{';
  if ((in_brackets && value.starts_with('[')) || (in_braces && value.starts_with('{')))
    return std::string(text).replace(at, length_in_brackets(text, at), value);
  if (std::holds_alternative<TomlArray>(old.value) || std::holds_alternative<TomlTable>(old.value))
    throw InputError(words_for_what_has_parts(old, path, in_brackets));
  return with_value(text, old, value);
}

std::string with_value(const std::string& text, const TomlValue& old, const std::string& value) {
  const std::size_t at = offset_of(text, old.line, old.column);
  std::string result = text;
  result.replace(at, length_of_scalar(text, at), value);
  return result;
}

std::string quoted_toml(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7F)
      result += fmt::format("\\u{:04X}", code);
    else
      result += c;
  }
  return result + "\"";
}

TomlValue parse_toml(const std::string& text, const std::string& shown_as) {
  refuse_deep_keys(text, shown_as);
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
