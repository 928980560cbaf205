#pragma once
// A CSV file with a row of numbers for each load step, which the file has after each.

#include "physics/tensor.h"
#include "postproc/files/growing_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

class StepTable {
 public:
  /// `names` are those of all columns, the first being the step's. Starts a table without rows, or continues the one
  /// on the disk, of which the rows up to `last_step` are kept. Throws ComputationError if the file cannot be written,
  /// as append() does; InputError that names file and line for what is not such a table.
  StepTable(std::filesystem::path path, std::vector<std::string> names, std::optional<Index> last_step);

  /// One number for each column; those that are not finite are written as nan. Without `now` the file has the row after
  /// write(), or the next one.
  void append(std::vector<double> row, bool now = true);
  void write();
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::string text() const;

  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
  GrowingFile file_;
  std::size_t n_written_ = 0;  // rows that the file has
};

}  // namespace pfdm
