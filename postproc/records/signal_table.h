#pragma once
// Measured or simulated signals as columns with names and units, and the files that hold them: CSV,
// MATLAB's .mat, universal files (dataset 58), HDF5, WAV.

#include "postproc/files/csv_table.h"

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
  std::string fault{};  ///< what is wrong with its first entry that is text, with file and line; such entries are NaN
};

struct SignalTable {
  std::string remark;  ///< what the file says about itself, as "synthetic: ..."
  std::vector<SignalColumn> columns;
  std::vector<std::string> notes{};  ///< for the log: what was left out or assumed when it was read
};

/// How the text of a CSV file is to be read.
struct SignalText {
  CsvMarks marks{};
  /// Tells a row of units from one of names; without it the second of two such rows has the units.
  bool (*is_unit)(std::string_view) = nullptr;
};

/// CSV: lines that start with # are remarks; then a row of names, mostly one of units, rows of numbers. Empty cells and
/// nan come back as NaN. Throws InputError that names file and line.
SignalTable read_signals_csv(const std::filesystem::path& path, const SignalText& text = {});
/// Written whole or not at all, numbers with the fewest digits that give the same value back.
void write_signals_csv(const std::filesystem::path& path, const SignalTable& table);

/// Every real numeric vector of a .mat file (versions 4, 5, 7; 7.3 where the library was built with HDF5), as MATLAB
/// names it: x, the columns of a matrix x(:,1) ... (rows x(1,:) ... where it is wider than long), fields of structures
/// rec.x, rec(2).x, rec.x(:,1). A text NAME_unit, or rec.NAME_unit, gives the unit of NAME and of all its columns. The
/// only reader that knows matio.
SignalTable read_signals_mat(const std::filesystem::path& path);

/// The functions of type 1 (time response) in the datasets 58 and 58b of a universal file, all over the same times: a
/// column "time", then one for each, called by its first ID line; where these do not differ by node and direction, as
/// "12+Z", or by the ordinate's label; or function_1, function_2 ... An ordinate that is an acceleration in "g" is in
/// multiples of gravity, g0. Zeros that fill the last line of a text dataset are left out.
SignalTable read_signals_uff(const std::filesystem::path& path);

/// Every real numeric vector of an HDF5 file, called by its path, as "run_1/base"; the text attribute "unit" or "units"
/// gives its unit, that of the file's root called "remark" its remark. The only reader that knows HDF5.
SignalTable read_signals_hdf5(const std::filesystem::path& path);

/// The channels of a WAV file (integers of 8 to 32 bits, divided by the largest; floating point as it stands): "time",
/// then channel_1, channel_2 ... without a unit. Title and comment are the remark. The only reader that knows
/// libsndfile.
SignalTable read_signals_wav(const std::filesystem::path& path);

/// By the file's extension: .csv, .mat, .uff and .unv, .h5 and .hdf5, .wav. Throws InputError for another. `text` is
/// of a .csv.
SignalTable read_signals(const std::filesystem::path& path, const SignalText& text = {});

}  // namespace pfdm
