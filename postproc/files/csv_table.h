#pragma once
// Tables of numbers as text: lines starting with # say where they come from, the next line names the columns, each with
// its unit, as in time_s,strain_xx,stress_xx_Pa.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CsvTable {
  std::vector<std::string> comments;  ///< without the #
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  std::size_t n_rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Throws InputError that names the columns there are.
  const std::vector<double>& column(std::string_view name) const;
  void add(std::string name, std::vector<double> values);
};

/// Throws InputError that names file and line for what is not a table: no header, a row of another length, a word where
/// a number is due, a name twice.
CsvTable read_csv(const std::filesystem::path& path);

/// Whole or not at all; numbers with the fewest digits that give the same double back. Throws ComputationError.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

}  // namespace pfdm
