#pragma once
// The damage D that degrades the stiffness, apart from the damage d of the surface energy (StiffnessBy::mean). With D =
// d each cell breaks by its own d, d = 1 in a row one cell thick. A growing crack leaves that row only by a jump of a
// cell's width: it locks to the rows of hexahedra. Here the stiffness sees the mean of d about a cell,
//
//   x = A d,  A: mean over the cell's vertices of the means over the cells around each (1/4, 1/2, 1/4 in a direction of
//             equal hexahedra), with weights 1 + lambda . r, r from the mean's place, that make both exact for linear
//             d; at a vertex of the body's surface r is along the surface: the cells are mirrored in it,
//   D = phi(x) = min(1, x + (1 - x_1) (x/x_1)^m),  m = 2 ell/h,  x_1 = 1 - 0.85 (1 - d(h))/2,
//
// d(s) being the profile about a crack and h^2/2 the variance of the mean's places in a direction (of equal hexahedra h
// is their edge), so that a crack that grows along a row costs about Gc. Where d varies smoothly D is d but for
// O((h/ell)^2). The energy is int g(D) psi and the surface energy of d; its derivative by d is
// A^T (g'(D) phi'(x) psi).
//
// Cells that have D = d are other shapes, undamageable ones and those with a material with a history or a split without
// energy. So are those beside other regions, cohesive faces or rows along planes of symmetry, and those whose mean
// reaches 1.5 times as far in one direction as in another, or has h > ell.

#include "solver/fracture/damage/vertex_means.h"
#include "solver/fracture/model/fracture_model.h"

namespace pfdm {

class StiffnessDamage {
 public:
  /// plane_normal: of one-cell-thick meshes, else zero.
  StiffnessDamage(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

  /// Whether D differs from d in some cell.
  bool any() const { return !means_.cells().empty(); }
  /// A v, by cell: v itself where D = d.
  CellField<double> means(const CellField<double>& v) const { return any() ? means_.of(v) : v; }
  /// A^T v.
  CellField<double> spread(const CellField<double>& v) const { return any() ? means_.spread(v) : v; }
  struct At {
    double value = 0.0, slope = 1.0, curvature = 0.0;  ///< D, dD/dx, d2D/dx2
  };
  At at(Index cell, double mean) const;
  /// D of every cell.
  CellField<double> of(const CellField<double>& d) const;

 private:
  struct Law {
    double broken = 1.0;  // x_1
    int power = 0;        // m; 0: D = d
  };

  VertexMeans means_;
  CellField<Law> laws_;
};

}  // namespace pfdm
