#pragma once
// Small VTK files as text, written by hand so that the reader is not tested against its own library.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace pfdm {

struct VtuText {
  struct Cell {
    int type;
    std::vector<Index> points;
    std::vector<Index> faces;  ///< of a polyhedron: [n_faces, n_points, p..., ...]
  };
  std::vector<Vector> points;
  std::vector<Cell> cells;
  std::map<std::string, std::vector<double>> cell_arrays, point_arrays;

  void write_vtu(const std::filesystem::path& path) const;
  void write_legacy(const std::filesystem::path& path) const;
};

/// The cells of a mesh in VTK's types, with the region's number in the cell array "region".
VtuText vtu_text(const Mesh& mesh);
/// The same with every cell as a polyhedron; the faces keep the mesh's direction, so half of them look inwards.
VtuText vtu_text_of_polyhedra(const Mesh& mesh);

}  // namespace pfdm
