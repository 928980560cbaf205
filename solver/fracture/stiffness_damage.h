#pragma once
// The damage D that degrades the stiffness, apart from the damage d of the surface energy (StiffnessBy::mean). With
// D = d each cell breaks by its own d, d = 1 in a row one cell thick, and a growing crack leaves that row only by a
// jump of a cell's width: it locks to the rows of hexahedra. Here the stiffness sees the mean of d about a cell,
//
//   x = A d,  A: mean over the cell's vertices of the means over the cells around each (1/4, 1/2, 1/4 in a direction),
//   D = phi(x) = min(1, x + (1 - x_1) (x/x_1)^m),  m = 2 ell/h,  x_1 = 1 - 0.85 (1 - d(h))/2,
//
// d(s) being the profile about a crack, so that one that grows along a row costs about Gc. Where d varies smoothly D is
// d but for O((h/ell)^2). The energy is int g(D) psi and the surface energy of d; its derivative by d is
// A^T (g'(D) phi'(x) psi).
//
// Cells that have D = d: other shapes, undamageable ones and those with a material with a history or a split without
// energy, those beside other regions or the surface of the body, beside cohesive faces or beside rows along planes of
// symmetry, more than 1.5 times as long as thick or thicker than ell.

#include "solver/fracture/fracture_model.h"

#include <vector>

namespace pfdm {

class StiffnessDamage {
 public:
  /// plane_normal: of one-cell-thick meshes, else zero.
  StiffnessDamage(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal);

  /// Whether D differs from d in some cell.
  bool any() const { return !averaged_.empty(); }
  /// A v, by cell: v itself where D = d.
  CellField<double> means(const CellField<double>& v) const;
  /// A^T v.
  CellField<double> spread(const CellField<double>& v) const;
  struct At {
    double value = 0.0, slope = 1.0, curvature = 0.0;  ///< D, dD/dx, d2D/dx2
  };
  At at(Index cell, double mean) const;
  /// D of every cell.
  CellField<double> of(const CellField<double>& d) const;

 private:
  struct Averaged {
    Index cell = 0;
    double broken = 1.0;  // x_1
    int power = 2;        // m
  };
  void list_vertices();

  const Mesh& mesh_;
  std::vector<Averaged> averaged_;
  CellField<Index> number_;                 // among them; -1: D = d
  std::vector<Index> vertex_of_point_;      // -1: of none of their cells
  std::vector<std::size_t> vertex_offset_;  // into
  std::vector<Index> cell_of_vertex_;       // the cells around each vertex
};

}  // namespace pfdm
