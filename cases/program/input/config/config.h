#pragma once
// A strict reader of case files. A table has rows of keys (key.h), or who reads it names them; another one in the file
// is an error, with the nearest of them, and so is one that nobody asked for in the end. A table that a row names is
// checked when it is opened. All functions throw InputError of the form
//   cases/x/case.toml:12: [mesh] "thicknes" is not known here; did you mean "thickness"? (allowed: ...)

#include "cases/program/input/config/config_value.h"

#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct Key;
struct KeyTable;

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
  /// Refuses the keys that `with` has beyond `there`: they go with what `need` names, which is not given.
  void refuse_keys_beyond(const KeyTable& there, const KeyTable& with, std::string_view need) const;

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
    return placed_at(*this, make);
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
  /// `lines`: of each line of the text the number that messages give it, 0: none; empty: its own.
  Config(const std::string& text, std::string shown_as, BareNumbers numbers = BareNumbers::refused,
         std::vector<int> lines = {});
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

}  // namespace pfdm
