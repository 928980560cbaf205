#pragma once
// Measured or simulated signals as columns with names and units, and the files that hold them: CSV with a row of units,
// MATLAB's .mat.

#include <Eigen/Core>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct SignalColumn {
  std::string name;
  std::string unit;  ///< empty where the file has none
  Eigen::VectorXd values;
};

struct SignalTable {
  std::string remark;  ///< what the file says about itself, as "synthetic: ..."
  std::vector<SignalColumn> columns;
};

/// CSV: lines that start with # are remarks; then a row of names, a row of units, rows of numbers. Empty cells and nan
/// come back as NaN. Throws InputError that names file and line.
SignalTable read_signals_csv(const std::filesystem::path& path);
/// Written whole or not at all, numbers with the fewest digits that give the same value back.
void write_signals_csv(const std::filesystem::path& path, const SignalTable& table);

/// Every real numeric vector of a .mat file (versions 4, 5, 7; 7.3 where the library was built with HDF5). A text
/// variable NAME_unit gives the unit of NAME. The only reader that knows matio.
SignalTable read_signals_mat(const std::filesystem::path& path);

/// By the file's extension. Throws InputError for one that is not known.
SignalTable read_signals(const std::filesystem::path& path);

}  // namespace pfdm
