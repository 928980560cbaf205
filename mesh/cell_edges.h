#pragma once
// The edges of a cell, each with the two faces of the cell that meet in it.

#include "mesh/mesh.h"

#include <array>
#include <vector>

namespace pfdm {

struct CellEdge {
  Index low, high;             ///< points, low < high
  std::array<Index, 2> faces;  ///< in ascending order
};

/// In ascending order of their points; `edges` is overwritten.
void list_edges(const Mesh& mesh, Index cell, std::vector<CellEdge>& edges);

}  // namespace pfdm
