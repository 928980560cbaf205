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
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< of each column, empty where it has none; or none at all
  std::vector<std::vector<double>> columns;

  std::size_t n_rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Number of the column of this name, to which a unit in brackets at its end need not belong. Throws InputError that
  /// names the columns there are.
  std::size_t find(std::string_view name) const;
  const std::vector<double>& column(std::string_view name) const { return columns[find(name)]; }
  void add(std::string name, std::vector<double> values);
};

/// Of files that others wrote; none: found.
struct CsvMarks {
  std::optional<char> separator{}, decimal{};
};

/// What a file may look like. A byte-order mark, blanks around entries and line ends of Windows are taken from any.
struct CsvOptions {
  bool has_units = false;                    ///< in the row below the names
  bool has_gaps = false;                     ///< an empty entry, nan and inf are no error; the first is NaN
  std::vector<std::string> whole_numbers{};  ///< columns that have no others
  /// Of a table that this program wrote: the names that it must have, in this order. It may have no rows, and nan in
  /// them; a last line without its line break is torn, of which even the last number may lack digits, and is left out.
  std::vector<std::string> own_names{};
  /// As instruments and spreadsheets write: separator and decimal mark are found if they are not given; lines before
  /// the names become comments; units stand below the names, or in brackets at their ends, or nowhere; entries may be
  /// in quotes, and a separator may end each line.
  bool is_foreign = false;
  std::optional<char> separator{}, decimal{};
  bool (*is_unit)(std::string_view) = nullptr;  ///< without it only what is in brackets is a unit
};

/// Throws InputError that names file, line and column for what is not a table: no header, a row of another length, a
/// word where a number is due, a name twice, a layout that can be read in two ways.
CsvTable read_csv(const std::filesystem::path& path, const CsvOptions& options = {});

/// Whole or not at all; numbers with the fewest digits that give the same double back. Throws ComputationError.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

}  // namespace pfdm
