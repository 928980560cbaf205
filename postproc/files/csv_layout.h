#pragma once
// How a table that an instrument or a spreadsheet wrote is laid out: what separates its entries, its decimal mark, and
// where its names, units and numbers are.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CsvLine {
  int number = 0;         ///< in the file, from 1
  std::string_view text;  ///< trimmed, neither empty nor a comment
};

struct CsvLayout {
  char separator = ',';  ///< a blank: any number of blanks and tabs
  char decimal = '.';
  std::size_t names = 0;                                             ///< the line of names; those before are remarks
  std::optional<std::size_t> units{};                                ///< the line of units, if there is one
  std::size_t rows() const { return (units ? *units : names) + 1; }  ///< the first line of numbers
};

/// What is known of it beforehand.
struct CsvHints {
  std::optional<char> separator{}, decimal{};
  bool has_units = false;                       ///< the line before the numbers has the units
  bool has_gaps = false;                        ///< entries may be empty
  bool (*is_unit)(std::string_view) = nullptr;  ///< without it only what is in brackets is a unit
};

/// The entries of a line, trimmed. Double quotes hold one together and are left out.
void split_csv(std::string_view line, char separator, std::vector<std::string>& words);

/// Nothing if the word is no number with this decimal mark.
std::optional<double> csv_number(std::string_view word, char decimal);

/// "[mm]" -> "mm", "(N)" -> "N"; nothing without brackets around all of it.
std::optional<std::string> in_brackets(std::string_view text);
/// "Force [N]" -> "N": the last brackets of a name, which has more than them.
std::optional<std::string> bracketed_end(std::string_view name);

/// The layout with which most lines are rows of numbers below a line of as many names; where there is none, that of the
/// first line. Throws InputError where 1,234 may be a thousand or a fraction.
CsvLayout find_layout(const std::vector<CsvLine>& lines, const CsvHints& hints);

}  // namespace pfdm
