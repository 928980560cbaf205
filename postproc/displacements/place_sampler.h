#pragma once
// Mean displacements of a computed body at places that were measured.

#include "mesh/mesh.h"
#include "mesh/search/box_tree.h"
#include "postproc/displacements/displacement_field.h"

#include <utility>
#include <vector>

namespace pfdm {

/// Cells of a mesh by place.
class CellLocator {
 public:
  explicit CellLocator(const Mesh& mesh);
  /// The cell around a point, or the nearest one, and how far the point is beyond its faces [m]; 0 inside.
  std::pair<Index, double> cell_at(const Vector& x) const;

 private:
  double beyond(Index cell, const Vector& x) const;
  const Mesh& mesh_;
  BoxTree tree_;
};

/// Of each place the mean of u_c + G_c (x - x_c) over its points, c the cell around each: second order, and never
/// across a crack or an interface, on the other side of which is another cell. Points are located once.
class PlaceSampler {
 public:
  PlaceSampler(const Mesh& mesh, const std::vector<FieldPlace>& places);
  /// [m], of displacements of cells [m] and their gradients [-].
  std::vector<Vector> operator()(const CellField<Vector>& displacement, const CellField<Tensor>& gradient) const;

 private:
  struct Share {
    Index cell;
    double weight;  ///< of its displacement
    Vector arm;     ///< of its gradient [m]
  };
  std::vector<std::vector<Share>> shares_;  // of each place
};

}  // namespace pfdm
