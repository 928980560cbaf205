#include "cases/program/input/case_files/case_override.h"

#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

struct Override {
  std::string key, value;
};

Override read_override(const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string key(trimmed(std::string_view(word).substr(0, equals)));
  if (equals == std::string::npos || key.empty())
    throw InputError(
        fmt::format("--set {}: expected KEY=VALUE, as in --set \"materials.steel.young_modulus=200 GPa\"", word));
  return {key, std::string(trimmed(std::string_view(word).substr(equals + 1)))};
}

/// Nothing if the text is no value of TOML, as a bare "200 GPa".
std::optional<TomlValue> toml_value(const std::string& text) {
  try {
    return value_at(parse_toml("x = " + text + "\n", "--set"), "x");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// A piece of TOML: what stands in place of a text is a text, whatever it looks like.
std::string piece_for(const TomlValue* old, const std::string& value) {
  const bool was_text = old != nullptr && std::holds_alternative<std::string>(old->value);
  const bool says_so = value.find_first_of("\"'[{") == 0;
  const auto given = toml_value(value);
  return given && (says_so || !was_text) ? value : quoted_toml(value);
}

const TomlValue* find_value(const TomlValue& root, const std::string& key) {
  try {
    return &value_at(root, key);
  } catch (const InputError&) {
    return nullptr;
  }
}

/// The line that opens a table, "[materials.steel]", or "[[boundary]]" of the element "boundary[1]", and how many alike
/// come before it.
struct Header {
  std::string line;
  int before = 0;
};

Header header_of(const std::string& table) {
  const std::size_t bracket = table.ends_with(']') ? table.rfind('[') : std::string::npos;
  if (bracket == std::string::npos) return {.line = "[" + table + "]"};
  const auto number = parse_int(std::string_view(table).substr(bracket + 1, table.size() - bracket - 2));
  return {.line = "[[" + table.substr(0, bracket) + "]]", .before = number ? static_cast<int>(*number) : 0};
}

/// `text` with `line` after the line that opens the table; nothing if no line does.
std::optional<std::string> after_header(const std::string& text, const std::string& table, const std::string& line) {
  const Header header = header_of(table);
  std::istringstream lines(text);
  std::string result;
  int found = 0;
  for (std::string each; std::getline(lines, each);) {
    result += each + "\n";
    const std::string_view head = trimmed(std::string_view(each).substr(0, each.find('#')));
    if (head == header.line && found++ == header.before) result += line + "\n";
  }
  return found > header.before ? std::optional(result) : std::nullopt;
}

/// A key below elements that are not there: a list is given as a whole.
InputError cannot_be_added(const TomlValue& root, const std::string& key) {
  for (std::size_t bracket = key.find('['); bracket != std::string::npos; bracket = key.find('[', bracket + 1)) {
    const std::string list = key.substr(0, bracket), below = key.substr(key.find_last_of('.') + 1);
    const std::size_t end = key.find(']', bracket);
    if (find_value(root, list) == nullptr)
      return InputError(fmt::format("--set {}: the case has no {}; a list is given as a whole, as {}=[{}]", key, list,
                                    list, key.ends_with(']') ? "..." : fmt::format("{{ {} = ... }}", below)));
    try {
      if (end != std::string::npos) value_at(root, key.substr(0, end + 1));
    } catch (const InputError& error) {
      return InputError(fmt::format("--set {}: {}", key, error.what()));
    }
  }
  const std::size_t dot = key.find_last_of('.');
  return InputError(fmt::format(
      "--set {0}: the case has no such key, and it cannot be added from outside: write it into the file, or set the "
      "table that holds it as a whole, {1}={{ {2} = ... }}",
      key, key.substr(0, dot), key.substr(dot + 1)));
}

/// Where a table's further key may stand depends on how the file writes the table: the first way that TOML allows.
std::string with_new_key(const std::string& text, const std::string& key, const std::string& piece) {
  const std::size_t dot = key.find_last_of('.');
  const std::string table = dot == std::string::npos ? "" : key.substr(0, dot), name = key.substr(dot + 1);
  const std::string on_top = fmt::format("{} = {}\n{}", key, piece, text);
  std::vector<std::string> ways{on_top};
  if (!table.empty()) {
    if (const auto within = after_header(text, table, fmt::format("{} = {}", name, piece)))
      ways.insert(ways.begin(), *within);
    ways.push_back(fmt::format("{}\n[{}]\n{} = {}\n", text, table, name, piece));
  }
  for (const std::string& way : ways) {
    try {
      if (find_value(parse_toml(way, "case.toml"), key) != nullptr) return way;
    } catch (const InputError&) {  // not in this way
    }
  }
  if (const TomlValue* const list = find_value(parse_toml(text, "case.toml"), table))
    if (std::holds_alternative<TomlArray>(list->value))
      throw InputError(
          fmt::format("--set {0}: {1} is a list: name one of its elements, as {1}[0].{2}", key, table, name));
  throw cannot_be_added(parse_toml(text, "case.toml"), key);
}

/// Of each line of `changed` which one of `text` it is, whose lines have these numbers; 0 where it is none.
std::vector<int> numbers_kept(const std::string& text, const std::string& changed, const std::vector<int>& numbers) {
  const auto lines_of = [](const std::string& all) {
    std::vector<std::string> lines;
    std::istringstream stream(all);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  };
  const std::vector<std::string> old = lines_of(text), now = lines_of(changed);
  const std::size_t both = std::min(old.size(), now.size());
  std::size_t before = 0, after = 0;
  while (before < both && old[before] == now[before]) ++before;
  while (after < both - before && old[old.size() - 1 - after] == now[now.size() - 1 - after]) ++after;
  std::vector<int> kept(now.size(), 0);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (i >= now.size() - after)
      kept[i] = numbers[i + old.size() - now.size()];
    else if (i < old.size() - after)
      kept[i] = numbers[i];
  }
  return kept;
}

std::string with_override(const std::string& text, const Override& given) {
  const TomlValue root = parse_toml(text, "case.toml");
  const TomlValue* const old = find_value(root, given.key);
  const std::string piece = piece_for(old, given.value);
  try {
    if (old != nullptr) return with_value(text, given.key, piece);
    if (given.key.ends_with(']')) value_at(root, given.key);  // says which elements there are
  } catch (const InputError& error) {
    throw InputError(fmt::format("--set {}: {}", given.key, error.what()));
  }
  return with_new_key(text, given.key, piece);
}

/// Whether a table stands below its head, [table], not in braces. One that is made of longer heads alone has none.
bool is_below_a_head(const std::string& text, const TomlValue& value) {
  if (!std::holds_alternative<TomlTable>(value.value)) return false;
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < value.line; ++i) std::getline(lines, line);
  const std::string_view head = trimmed(line);
  return head.starts_with('[') && !head.starts_with("[[");
}

/// The text without a table below its head that a table in braces takes the place of.
std::string without_replaced_table(const std::string& text, const Override& given) {
  const TomlValue root = parse_toml(text, "case.toml");
  const TomlValue* const old = find_value(root, given.key);
  const bool is_replaced = old != nullptr && given.value.starts_with('{') && is_below_a_head(text, *old);
  return is_replaced ? with_table_replaced(text, given.key, "") : text;
}

}  // namespace

CaseFile with_overrides(const CaseFile& file, std::span<const std::string> words) {
  if (words.empty()) return file;
  std::string text = file.text;
  std::vector<int> numbers(static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1);
  std::iota(numbers.begin(), numbers.end(), 1);
  for (const std::string& word : words) {
    const Override given = read_override(word);
    for (const auto& changed_by : {without_replaced_table, with_override}) {
      std::string next = changed_by(text, given);
      numbers = numbers_kept(text, next, numbers);
      text = std::move(next);
    }
  }
  const std::string shown = file.config.root().at("kind").file();
  CaseFile changed = file;
  changed.config = Config(text, shown + " with --set", BareNumbers::refused, std::move(numbers));
  changed.text = std::move(text);
  return changed;
}

}  // namespace pfdm
