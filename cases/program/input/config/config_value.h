#pragma once
// One value of a case file, read as what is due there: a text, a number within a range, a quantity of a dimension, one
// of some words. All functions throw InputError of the form
//   cases/x/case.toml:12: [mesh] thickness: 0 must be positive

#include "cases/program/input/config/toml_document.h"
#include "cases/program/input/config/units.h"
#include "physics/error.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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
struct KeyType;

/// Calls `make`; an InputError that it throws gets the place of a value or table.
template <class Where, class Make>
auto placed_at(const Where& where, const Make& make) {
  try {
    return make();
  } catch (const InputError& cause) {
    throw where.error(cause.what());
  }
}

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
    return placed_at(*this, make);
  }

 private:
  std::string shown_with_unit_due(const Dimension& due) const;

  std::shared_ptr<ConfigSource> source_;  // owns what value_ points to
  const TomlValue* value_;
  std::string place_;  // as in "[mesh] thickness"
  std::string path_;   // of a table: mesh.layers
  const KeyType* type_;
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
