#pragma once
// Slopes across the faces of cells whose elasticity is that of axes which turn from cell to cell.
//
// By the traction T = n.C:G on a face with the normal n, the gradient being E along the face and y n^T across it, and
// A = n.C.n, y = A^-1 T - R:E with R = A^-1 n.C. Let axes turn smoothly across layers. Then R:E of a place between
// cells, or beyond the last one, is extrapolated as E is, and the slope of a cell there changes by what R:E has beyond
// R of that cell times E.

#include "mesh/mesh.h"
#include "physics/elasticity/mandel.h"
#include "solver/momentum/body/unknowns.h"

namespace pfdm {

class TurnedStiffness {
 public:
  using Rows = Eigen::Matrix<double, 3, 6>;

  TurnedStiffness(const Mesh& mesh, const Unknowns& unknowns) : mesh_(mesh), unknowns_(unknowns) {}

  /// Whether two cells of a zone differ in their elasticity. Not in bodies with eigenstrains, of which slopes by whole
  /// strains know nothing.
  bool turns(Index cell, Index other) const;
  /// By the strain of the other cell (Mandel): (R_other - R_cell) strain.
  Rows slope_along(Index cell, Index other, const Vector& n) const;
  /// On a face that cuts the layers, by the strain of the other cell: A^-1 n.(C_other - C_cell) strain.
  Rows slope_cutting(Index cell, Index other, const Vector& n) const;

 private:
  MandelMatrix stiffness(Index cell) const;  // condensed in plane stress [Pa]

  const Mesh& mesh_;
  const Unknowns& unknowns_;
};

}  // namespace pfdm
