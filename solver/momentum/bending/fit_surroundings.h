#pragma once
// The samples of cubic_faces.h about a cell.

#include "mesh/mesh.h"
#include "solver/momentum/body/unknowns.h"

#include <vector>

namespace pfdm {

class FitSurroundings {
 public:
  /// For use while both exist.
  FitSurroundings(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {}

  /// Nodes about a cell, in the order of their numbers. Of a hexahedron: the cells of its zone within two faces, the
  /// second face being opposite to the first or reached in two ways (else a notch may lie between), and the nodes of
  /// the cell and of its neighbours. Of a prism: the cells of its zone that share a point with it, those across their
  /// faces, and the nodes of all these; as far as a straight line from the cell to them runs through its zone.
  std::vector<Index> of(Index cell);

 private:
  std::vector<Index> of_prism(Index cell);
  std::vector<Index> samples(Index cell);
  Index across(Index cell, Index face) const;
  Index beyond(Index cell, Index face);
  void extend(Index cell, Index neighbour, Index face);
  bool sees(Index cell, Index other, const Vector& place) const;

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  std::vector<Index> cells_, nodes_, corners_;
};

}  // namespace pfdm
