#pragma once
// SDRC's universal file, dataset 58, "function at nodal DOF", as text (58) and with binary data (58b). Records as in
// the University of Cincinnati's "Universal file formats for modal analysis testing".

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

constexpr int uff_time_response = 1;  ///< type of a function over time

/// What the data values are (records 7 and 12).
struct UffValueType {
  bool is_double = false;
  bool is_complex = false;
};

/// A function at a degree of freedom: values over an abscissa.
struct UffFunction {
  std::string id;     ///< the first of five lines
  std::string place;  ///< response's node and direction, "12+Z"
  std::string label;  ///< of the ordinate
  int type = 0;       ///< of the function
  UffValueType values;
  std::size_t n = 0;
  bool even = true;                ///< abscissa
  double first = 0.0, step = 0.0;  ///< of an even abscissa
  std::string abscissa_unit, unit;
  std::vector<double> abscissa, ordinate;
  std::size_t n_filling = 0;  ///< zeros after the last value
  bool was_in_g = false;      ///< its unit was called g
};

/// All functions of a file; those over time with their values. Throws InputError, naming the file and the line at which
/// the dataset begins, if there is none or one cannot be read.
std::vector<UffFunction> read_uff(const std::filesystem::path& path);

}  // namespace pfdm
