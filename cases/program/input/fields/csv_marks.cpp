#include "cases/program/input/fields/csv_marks.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {
namespace {

std::optional<char> read_mark(const ConfigTable& table, const char* key, std::initializer_list<std::string> names,
                              std::string_view marks) {
  const auto value = table.find(key);
  if (!value) return std::nullopt;
  const std::vector<std::string> allowed(names);
  const auto chosen = std::ranges::find(allowed, value->one_of(allowed, key)) - allowed.begin();
  return marks[chosen];
}

}  // namespace

CsvMarks read_csv_marks(const ConfigTable& table) {
  const CsvMarks marks{.separator = read_mark(table, "separator", {",", ";", "tab", "blank"}, ",;\t "),
                       .decimal = read_mark(table, "decimal", {".", ","}, ".,"),
                       .thousands = read_mark(table, "thousands", {".", ",", "'", "blank"}, ".,' ")};
  if (marks.separator && marks.separator == marks.decimal)
    throw table.at("separator").error("a comma cannot separate entries and be the decimal mark");
  if (marks.thousands && marks.thousands == marks.decimal)
    throw table.at("thousands").error("the mark between thousands cannot be the decimal mark too");
  return marks;
}

}  // namespace pfdm
