#pragma once
// A TOML file as plain data with line numbers. The only place that knows toml++.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pfdm {

struct TomlValue;
struct TomlEntry;
using TomlArray = std::vector<TomlValue>;
/// In the order of the text.
using TomlTable = std::vector<TomlEntry>;

struct TomlValue {
  std::variant<std::string, bool, std::int64_t, double, TomlArray, TomlTable> value;
  int line = 0;      ///< where the value stands
  int column = 0;    ///< likewise, in characters; the first is 1
  int key_line = 0;  ///< where its key stands, or the same
};

struct TomlEntry {
  std::string key;
  TomlValue value;
};

/// The value that a path leads to, as in "materials.glass.young_modulus" or "mesh.particles[0].diameter". Throws
/// InputError that says where the path ends and what there is.
const TomlValue& value_at(const TomlValue& root, std::string_view path);

/// `text` with the text or number at `path` written anew as `value`, a piece of TOML; all else stays, comments too. A
/// list in brackets takes the place of one, a table in braces that of one in braces.
std::string with_value(const std::string& text, std::string_view path, const std::string& value);

/// Likewise for a value that parse_toml() found in `text`.
std::string with_value(const std::string& text, const TomlValue& old, const std::string& value);

/// A piece of TOML that stands for `text`.
std::string quoted_toml(std::string_view text);

/// `shown_as` is the file's name in messages. Throws InputError with the line of what TOML does not allow.
TomlValue parse_toml(const std::string& text, const std::string& shown_as);

/// The value in one form only, whatever the layout and the comments of its file; the keys of tables in their order.
std::string written(const TomlValue& value);

/// The value as TOML would write it, shortened, for messages.
std::string shown(const TomlValue& value);

}  // namespace pfdm
