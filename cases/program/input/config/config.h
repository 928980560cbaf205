#pragma once
// A strict reader of case files. A table has rows of keys (key.h), or who reads it names them; another one in the file
// is an error, with the nearest of them, and so is one that nobody asked for in the end. A table that a row names is
// checked when it is opened. All functions throw InputError of the form
//   cases/x/case.toml:12: [mesh] "thicknes" is not known here; did you mean "thickness"? (allowed: ...)

#include "cases/program/input/config/toml_document.h"
#include "cases/program/input/config/units.h"
#include "physics/error.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// What a number may be; SI values for quantities.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool open = false;                  ///< the ends do not belong to it
  std::string_view words = "finite";  ///< for messages: "must be ..."
  bool holds(double value) const;
};
namespace range {
inline constexpr Range any{};
inline constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true, "positive"};
inline constexpr Range not_negative{0.0, std::numeric_limits<double>::infinity(), false, "zero or positive"};
inline constexpr Range fraction{0.0, 1.0, false, "between 0 and 1"};
inline constexpr Range count{1.0, 1e6, false, "between 1 and 1000000"};
inline constexpr Range seed{0.0, 1e15, false, "between 0 and 1e15"};
/// What the solver is tested for.
inline constexpr Range poisson_ratio{-1.0 + std::numeric_limits<double>::epsilon(), 0.4999, false,
                                     "above -1 and at most 0.4999"};
}  // namespace range

struct ConfigSource;
class ConfigTable;
struct Key;
struct KeyTable;
struct KeyType;

/// One value of the file, with its place for messages.
class ConfigValue {
 public:
  /// `type`: what the row of its key says of it (key.h), if there is one.
  ConfigValue(std::shared_ptr<ConfigSource> source, const TomlValue* value, std::string place, std::string path,
              const KeyType* type = nullptr)
      : source_(std::move(source)), value_(value), place_(std::move(place)), path_(std::move(path)), type_(type) {}

  bool is_string() const { return std::holds_alternative<std::string>(value_->value); }
  bool is_list() const { return std::holds_alternative<TomlArray>(value_->value); }
  bool is_table() const { return std::holds_alternative<TomlTable>(value_->value); }

  std::string string() const;
  std::string line() const;  ///< a text without line breaks, for heads of files and tables
  bool boolean() const;
  std::int64_t integer(const Range& allowed) const;
  double number(const Range& allowed) const;
  double quantity(const Dimension& due, const Range& allowed = range::any) const;  ///< [due.si_unit]
  /// Likewise, of the range and dimension that the key's row says.
  std::int64_t integer() const;
  double number() const;
  double quantity() const;
  double real() const;         ///< a quantity or a number, whichever the row says
  std::string choice() const;  ///< one of the words that the row lists
  const KeyType* type() const { return type_; }
  /// A string that must be one of `allowed`; `what` says of what, as in "patch of the mesh".
  std::string one_of(std::span<const std::string> allowed, std::string_view what) const;
  /// The elements; `n` of them, if it is given.
  std::vector<ConfigValue> list(std::optional<std::size_t> n = std::nullopt) const;
  ConfigTable table() const;

  const std::string& file() const;  ///< as shown in messages
  InputError error(std::string_view message) const;
  /// Notes for the log what was made of this value: what was left out, merged or assumed. Once, however often it is
  /// read.
  void remark(std::string_view message) const;
  /// Calls `make`; an InputError that it throws gets this value's place.
  template <class Make>
  auto in_context(const Make& make) const {
    try {
      return make();
    } catch (const InputError& cause) {
      throw error(cause.what());
    }
  }

 private:
  std::string shown_with_unit_due(const Dimension& due) const;

  std::shared_ptr<ConfigSource> source_;  // owns what value_ points to
  const TomlValue* value_;
  std::string place_;  // as in "[mesh] thickness"
  std::string path_;   // of a table: mesh.layers
  const KeyType* type_;
};

/// A table of the file. Getters with a default take it where the key is missing; the others throw then.
class ConfigTable {
 public:
  ConfigTable(std::shared_ptr<ConfigSource> source, const TomlValue* value, std::string path);

  /// The same table, after it is known which keys it may have: throws for any other one in the file. Those that were
  /// asked for before, such as the one that decides which others there are, need not be named. To ask for a key that
  /// was not named is a mistake of the program's (std::logic_error), and so is to name another one when a table is read
  /// again.
  ConfigTable with_keys(std::span<const std::string_view> keys) const;
  ConfigTable with_keys(std::initializer_list<std::string_view> keys) const {
    return with_keys(std::span(keys.begin(), keys.size()));
  }

  /// By the rows of keys of a table (key.h), which live as long as the program; `decided`: the value of the key that
  /// decides which of them there are, if it is not the one that the file has.
  ConfigTable with_keys(const KeyTable& rows, std::optional<std::string_view> decided = std::nullopt) const;
  /// Those that the table may have, in their order.
  std::vector<const Key*> rows() const;

  bool has(std::string_view key) const;
  ConfigValue at(std::string_view key) const;
  std::optional<ConfigValue> find(std::string_view key) const;
  /// All entries, for tables whose keys are names that the user chooses.
  std::vector<std::pair<std::string, ConfigValue>> entries() const;

  std::string string(std::string_view key) const { return at(key).string(); }
  std::string string(std::string_view key, std::string_view otherwise) const;
  std::string line(std::string_view key) const { return at(key).line(); }
  bool boolean(std::string_view key, bool otherwise) const;
  std::int64_t integer(std::string_view key, const Range& allowed) const { return at(key).integer(allowed); }
  std::int64_t integer(std::string_view key, const Range& allowed, std::int64_t otherwise) const;
  double number(std::string_view key, const Range& allowed) const { return at(key).number(allowed); }
  double number(std::string_view key, const Range& allowed, double otherwise) const;
  double quantity(std::string_view key, const Dimension& due, const Range& allowed = range::any) const;
  double quantity(std::string_view key, const Dimension& due, const Range& allowed, double otherwise) const;
  /// Of the range and dimension that the key's row says.
  std::int64_t integer(std::string_view key) const { return at(key).integer(); }
  std::int64_t integer(std::string_view key, std::int64_t otherwise) const;
  double number(std::string_view key) const { return at(key).number(); }
  double number(std::string_view key, double otherwise) const;
  double quantity(std::string_view key) const;
  double quantity(std::string_view key, double otherwise) const;
  std::string choice(std::string_view key) const { return at(key).choice(); }
  std::string choice(std::string_view key, std::string_view otherwise) const;
  std::vector<std::string> strings(std::string_view key) const;
  ConfigTable table(std::string_view key) const;
  /// An array of tables, [[key]]; empty if there is none.
  std::vector<ConfigTable> tables(std::string_view key) const;

  InputError error(std::string_view message) const;
  void remark(std::string_view message) const;  ///< as of a value
  template <class Make>
  auto in_context(const Make& make) const {
    try {
      return make();
    } catch (const InputError& cause) {
      throw error(cause.what());
    }
  }

 private:
  const TomlTable& content() const { return std::get<TomlTable>(value_->value); }
  InputError missing(std::string_view key, std::string_view what) const;
  ConfigValue required(std::string_view key, std::string_view what) const;
  ConfigValue required_quantity(std::string_view key, const Dimension& due) const;
  const KeyType* type_of(std::string_view key) const;

  std::shared_ptr<ConfigSource> source_;
  const TomlValue* value_;
  std::string path_;
};

/// Whether a number may stand where a quantity is due: in a case file none may, in values of a script it is in the SI
/// unit.
enum class BareNumbers { refused, in_si };

/// A key that stands in a case file and has a row.
struct GivenKey {
  std::string path;  ///< "mesh.particles[0].diameter"
  const Key* row = nullptr;
  const TomlValue* value = nullptr;  ///< the Config's
};

/// A case file. Keep it until reject_unknown_keys() has been called, after everything was read.
class Config {
 public:
  /// `text` is the file's content, `shown_as` its name in messages.
  Config(const std::string& text, std::string shown_as, BareNumbers numbers = BareNumbers::refused);
  ConfigTable root() const;
  void reject_unknown_keys() const;
  /// What those who read it have noted so far, with its places.
  const std::vector<std::string>& remarks() const;
  /// The keys of the tables that were read, in the order of the text; tables stand for themselves where a plain value
  /// could, as { expr, unit }, and else by their keys.
  std::vector<GivenKey> given_keys() const;

 private:
  std::shared_ptr<ConfigSource> source_;
};

/// The row of a table of laws, generators ... that `value` names; `what` says of what kind it is.
template <class Row>
const Row& choose(const ConfigValue& value, std::span<const Row> table, std::string_view what) {
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  const std::string name = value.one_of(names, what);
  return *std::find_if(table.begin(), table.end(), [&](const Row& row) { return row.name == name; });
}

/// The candidate with the smallest edit distance to `word`, if it is near enough to be what was meant.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);
/// For a message: "; did you mean "thickness"?", or nothing where no candidate is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace pfdm
