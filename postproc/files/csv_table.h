#pragma once
// Tables of numbers as text, the one reader of CSV files: lines starting with # say where they come from, the next line
// names the columns, each with its unit, as in time_s,strain_xx,stress_xx_Pa, or the line after it has the units.
// Tables that others wrote may differ (csv_layout.h).

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CsvTable {
  std::vector<std::string> comments;  ///< without the #
  std::vector<std::string> names;     ///< empty ones of a table without names
  std::vector<std::string> units;     ///< of each column, empty where it has none; or none at all
  std::vector<std::vector<double>> columns;
  /// Of each column of a foreign table: what is wrong with its first entry that is no number, with file and line; empty
  /// where all are. Such entries are NaN.
  std::vector<std::string> faults{};

  std::size_t n_rows() const { return columns.empty() ? 0 : columns.front().size(); }
  bool has_names() const;
  /// Number of the column of this name, by find_name(). Throws InputError that names the columns there are.
  std::size_t find(std::string_view name) const;
  const std::vector<double>& column(std::string_view name) const { return columns[find(name)]; }
  /// Throws InputError if an entry of the column is text.
  void require_numbers(std::size_t column) const;
  void add(std::string name, std::vector<double> values);
};

/// "Force" of "Force [N]"; others as they are.
std::string_view without_unit(std::string_view name);

/// Which of `names` is meant: the same one; or without a unit in brackets at its end; or with other capitals. Throws
/// InputError that lists them where it is none, or might be several.
std::size_t find_name(const std::vector<std::string>& names, std::string_view name);

/// Of files that others wrote; none: separator and decimal mark are found, and thousands are not apart.
struct CsvMarks {
  std::optional<char> separator{}, decimal{}, thousands{};
};

/// What a file may look like. A byte-order mark, blanks around entries and line ends of Windows are taken from any.
struct CsvOptions {
  bool has_units = false;                    ///< in the row below the names; a foreign table may do without
  bool has_gaps = false;                     ///< an empty entry, nan and inf are no error; the first is NaN
  std::vector<std::string> whole_numbers{};  ///< columns that have no others
  /// Of a table that this program wrote: the names that it must have, in this order. It may have no rows, and nan in
  /// them; a last line without its line break is torn, of which even the last number may lack digits, and is left out.
  std::vector<std::string> own_names{};
  /// As many of them, the last ones, may be missing: earlier builds did not write them. They are 0 then.
  std::size_t n_newer_names = 0;
  /// As instruments and spreadsheets write: separator and decimal mark are found if they are not given; lines before
  /// the names become comments, and names may be missing; units stand below the names, or in brackets at their ends, or
  /// nowhere; entries may be in quotes, and a separator may end each line. An entry that is empty, nan, NA, N/A, null
  /// or none is NaN, and so is text, which is a fault of its column.
  bool is_foreign = false;
  CsvMarks marks{};
  bool (*is_unit)(std::string_view) = nullptr;  ///< without it only what is in brackets is a unit
};

/// Throws InputError that names file, line and column for what is not a table: no header, a row of another length, a
/// word where a number is due, a name twice (not of foreign tables), a layout that can be read in two ways.
CsvTable read_csv(const std::filesystem::path& path, const CsvOptions& options = {});

/// Whole or not at all; numbers with the fewest digits that give the same double back. Throws ComputationError.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

}  // namespace pfdm
