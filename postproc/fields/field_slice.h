#pragma once
// What a plane cuts out of a frame of a run, and the faces of a frame of interfaces (VTK).

#include "physics/tensor.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pfdm {

struct FieldSlice {
  struct Cell {
    std::vector<Vector> corners;  ///< [m]
    double value = 0.0;
  };
  std::vector<Cell> cells;
  std::vector<std::array<Vector, 2>> borders;  ///< between cells of different materials [m]
};

/// A frame (.vtu) as this program writes it, in memory.
class StoredFrame {
 public:
  /// Throws InputError if it cannot be read.
  explicit StoredFrame(const std::filesystem::path& file);
  ~StoredFrame();
  StoredFrame(const StoredFrame&) = delete;
  StoredFrame& operator=(const StoredFrame&) = delete;

  Index n_cells() const;
  Vector lower() const;  ///< corner of the box that holds all points [m]
  Vector upper() const;
  /// The scalar `field` of the cells on the plane through `point` [m] with the given normal. Where it runs along faces
  /// it is moved by a millionth of the body, to one side. Throws InputError if there is no such field.
  FieldSlice slice(const Vector& point, const Vector& normal, const std::string& field) const;
  /// The polygons of a frame of interfaces, with their scalar `field`. Throws InputError if there is no such field.
  std::vector<FieldSlice::Cell> faces(const std::string& field) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pfdm
