#pragma once
// What a case file is read from: its values, which tables were looked into and what they were asked for. Of config.h
// alone.

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct ConfigSource {
  std::string file;
  BareNumbers numbers = BareNumbers::refused;
  std::vector<int> lines{};  // that messages name in place of those of the text, from its first on; 0: none
  TomlValue root;
  struct Opened {
    std::string path;
    std::set<std::string> asked_for;
    std::set<std::string> allowed;   // all keys, where they were named
    std::vector<const Key*> rows{};  // where the table has some
    const KeyType* entry = nullptr;  // of all keys, where the user chooses their names
    const std::set<std::string>& known() const { return allowed.empty() ? asked_for : allowed; }
    std::string place() const { return place_of_table(path); }
    /// A key of the program's own that is not among those named is a mistake of the program's.
    void require_named(std::string_view key) const;
  };
  std::map<const TomlTable*, Opened> opened;  // tables that were looked into
  std::vector<std::string> remarks;

  /// "[mesh] ", nothing of the root
  static std::string place_of_table(const std::string& path);
  static std::string place_of_key(const std::string& path, std::string_view key);
  static std::string subtable(const std::string& path, std::string_view key);

  InputError error_at(int line, const std::string& message) const;
  /// Each once.
  void remark_at(int line, const std::string& message);
  /// `list`: whether the keys that are known are all there are.
  InputError unknown_key(const Opened& table, const std::string& key, int line, bool list) const;
  /// Throws InputError for a key of the table that is there only with other values of the key that decides.
  void refuse_keys_of_others(const Opened& table, const TomlTable& content, const KeyTable& rows,
                             std::string_view decided) const;
  /// Throws InputError for the first key that nobody asked for.
  void reject_unknown_keys() const { reject_unknown_in(root); }
  std::vector<GivenKey> given_keys() const;

 private:
  std::string said_at(int line, const std::string& message) const;
  InputError idle_key(const Opened& table, const std::string& key, int line) const;
  void reject_unknown_in(const TomlValue& value) const;
};

/// The alternative of a type that is of that kind. What asks for another kind than the row says is a mistake of the
/// program's.
const KeyType& due_of(const KeyType* type, KeyType::Kind kind, const std::string& place);

}  // namespace pfdm
