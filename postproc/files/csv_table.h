#pragma once
// Tables of numbers as text, the one reader of CSV files: lines starting with # say where they come from, the next line
// names the columns, each with its unit, as in time_s,strain_xx,stress_xx_Pa, or the line after it has the units.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CsvTable {
  std::vector<std::string> comments;  ///< without the #
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< of each column, or none at all
  std::vector<std::vector<double>> columns;

  std::size_t n_rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Throws InputError that names the columns there are.
  const std::vector<double>& column(std::string_view name) const;
  void add(std::string name, std::vector<double> values);
};

/// What a file may look like. A byte-order mark, blanks around entries and line ends of Windows are taken from any.
struct CsvOptions {
  bool has_units = false;                    ///< in the row below the names
  bool has_gaps = false;                     ///< an empty entry, nan and inf are no error; the first is NaN
  std::vector<std::string> whole_numbers{};  ///< columns that have no others
  /// Of a table that this program wrote: the names that it must have, in this order. It may have no rows, and nan in
  /// them; a last line without its line break is torn, of which even the last number may lack digits, and is left out.
  std::vector<std::string> own_names{};
};

/// Throws InputError that names file, line and column for what is not a table: no header, a row of another length, a
/// word where a number is due, a name twice.
CsvTable read_csv(const std::filesystem::path& path, const CsvOptions& options = {});

/// Whole or not at all; numbers with the fewest digits that give the same double back. Throws ComputationError.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

}  // namespace pfdm
