#pragma once
// The cells of a frame of a run as they are in the file (VTK).

#include "physics/tensor.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pfdm {

/// Of a file that this program wrote (vtu_writer.h). Cells have the same order and corners in all files of a run; a
/// corner may have another point where cracks part the cells.
class StoredCells {
 public:
  /// Throws InputError if it cannot be read.
  explicit StoredCells(const std::filesystem::path& file);
  ~StoredCells();
  StoredCells(const StoredCells&) = delete;
  StoredCells& operator=(const StoredCells&) = delete;

  Index n_cells() const;
  std::vector<Vector> points() const;  ///< [m]
  /// Of each cell its number of corners: 4, 5, 6, 8, or 0 for a polyhedron. Throws InputError for other cells.
  std::vector<std::uint8_t> shapes() const;
  /// Appends the points of a cell's corners; of a polyhedron those of its faces, one after the other, and to `faces`
  /// the number of faces and of the corners of each.
  void append_corners(Index cell, std::vector<Index>& corners, std::vector<Index>& faces) const;
  /// By number.
  std::vector<std::string> regions() const;
  bool has(const std::string& field) const;
  /// A component of a field of the cells. Throws InputError if there is no such field.
  std::vector<double> values(const std::string& field, int component = 0) const;
  /// Of the points [m]. Throws likewise.
  std::vector<Vector> displacement() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pfdm
