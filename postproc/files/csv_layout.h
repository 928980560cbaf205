#pragma once
// How a table that an instrument or a spreadsheet wrote is laid out: what separates its entries, its decimal mark, and
// where its names, units and numbers are.

#include "postproc/files/csv_words.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace pfdm {

struct CsvLine {
  int number = 0;         ///< in the file, from 1
  std::string_view text;  ///< neither empty nor a comment; without blanks at either end, but with tabs
};

struct CsvLayout {
  char separator = ',';  ///< a blank: any number of blanks and tabs
  char decimal = '.';
  std::optional<char> thousands{};     ///< between the thousands of a number
  std::optional<std::size_t> names{};  ///< the line of names
  std::optional<std::size_t> units{};  ///< the line of units
  std::size_t rows = 1;                ///< the first line of numbers; those before that say nothing else are remarks
};

/// What is known of it beforehand.
struct CsvHints {
  std::optional<char> separator{}, decimal{}, thousands{};
  bool has_units = false;                       ///< a line of names as long before the last one is not a remark
  bool has_gaps = false;                        ///< entries may be empty
  bool (*is_unit)(std::string_view) = nullptr;  ///< without it only what is in brackets is a unit
};

/// The layout with which most lines are rows of numbers below a line of as many names. Where other entries stand
/// between the numbers, that of the successive lines with the most numbers; where there are no names, that of the most
/// numbers; where there is no row, that of the first line. Throws InputError where 1,234 may be a thousand or a
/// fraction.
CsvLayout find_layout(const std::vector<CsvLine>& lines, const CsvHints& hints);

}  // namespace pfdm
