#pragma once
// A dataset of HDF5 that grows by rows: numbers of one type, one or several in a row, in compressed chunks.

#include "postproc/hdf5/hdf5_handle.h"

#include <cstdint>
#include <memory>
#include <string>

namespace pfdm {

/// The type of HDF5 in which values of a C++ type are kept in memory and in files; little-endian in the file.
template <class Number>
hid_t hdf5_type();

class GrowingDataset {
 public:
  /// Makes the dataset `name` in a group, without rows yet. `columns`: numbers in a row, 0 for a dataset of one
  /// dimension. `type`: of the values in memory, as hdf5_type() gives it. `chunk`: rows of a chunk. Throws
  /// ComputationError if HDF5 cannot make it.
  GrowingDataset(hid_t group, const std::string& name, hid_t type, hsize_t columns, hsize_t chunk);

  /// Appends rows; `values` has columns numbers for each. Throws ComputationError if they cannot be written.
  void append(const void* values, hsize_t rows);
  hsize_t rows() const { return rows_; }
  /// Adds a text to the dataset, as its unit. Throws likewise.
  void describe(const char* attribute, const std::string& text);

 private:
  std::string name_;
  hid_t type_;
  hsize_t columns_, rows_ = 0;
  std::unique_ptr<Hdf5Handle> dataset_;
};

/// Writes a text of fixed length as an attribute of a group or dataset. Throws ComputationError.
void write_hdf5_text(hid_t object, const char* name, const std::string& text);
/// Writes whole numbers as an attribute: one, or a list. Throws ComputationError.
void write_hdf5_numbers(hid_t object, const char* name, const std::int64_t* values, hsize_t n, bool is_list);

}  // namespace pfdm
