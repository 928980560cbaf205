#include "cases/program/input/config/csv_keys.h"

namespace pfdm {
namespace {

constexpr Range column_numbers{1.0, 1e6, false, "the number of a column, from 1"};

}  // namespace

KeyType column_type() { return keys::either({keys::text("column"), keys::whole(column_numbers)}); }

std::vector<Key> csv_mark_keys() {
  using namespace keys;
  return {
      {"separator", choice("separator", {",", ";", "tab", "blank"}), "found",
       "What stands between the entries of the CSV file, where its layout cannot be found."},
      {"decimal", choice("decimal", {".", ","}), "found",
       "Decimal mark of the numbers in the CSV file, a point or a comma, where it cannot be found."},
      {"thousands", choice("thousands", {".", ",", "'", "blank"}), "none",
       "What stands between the thousands of a number in the CSV file, as in 1.032,66."},
  };
}

std::vector<Key> csv_keys() {
  return keys::joined({{{"csv", keys::path(), "", "CSV file with the measured or computed data, seen from the case."}},
                       csv_mark_keys()});
}

const KeyTable& column_keys() {
  using namespace keys;
  static const KeyTable table{.name = "column",
                              .sentence = "A column of a CSV file.",
                              .keys = {{"column", column_type(), "",
                                        "Column of the CSV file: its name, in capitals or not, or its number from 1."},
                                       {"unit", text("unit"), "that of the file, else SI",
                                        "Unit of the column's values, where the file does not state it."}}};
  return table;
}

}  // namespace pfdm
