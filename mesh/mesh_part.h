#pragma once
// Some cells of a mesh as a mesh of their own.

#include "mesh/mesh.h"

namespace pfdm {

struct MeshPart {
  /// Cells and faces in the order of the whole; its patches, perhaps without faces, then one more, "cut": the faces to
  /// cells that are not in the part. It has no points: the geometry is that of the whole.
  Mesh mesh;
  std::vector<Index> cell;  ///< number in the whole of each cell of the part
  std::vector<Index> face;  ///< of each face likewise
  Index cut = 0;            ///< entry into the patches

  const Patch& cut_patch() const { return mesh.patches[as_size(cut)]; }
};

/// cells: in ascending order.
MeshPart part_of(const Mesh& whole, std::vector<Index> cells);

/// The values of some cells; of an empty field an empty one.
template <class T>
CellField<T> take_out(const CellField<T>& whole, const std::vector<Index>& cells) {
  CellField<T> part(whole.size() > 0 ? cells.size() : 0);
  for (Index i = 0; i < part.size(); ++i) part[i] = whole[cells[as_size(i)]];
  return part;
}

/// Writes them back.
template <class T>
void put_back(const CellField<T>& part, const std::vector<Index>& cells, CellField<T>& whole) {
  for (Index i = 0; i < part.size(); ++i) whole[cells[as_size(i)]] = part[i];
}

}  // namespace pfdm
