#pragma once
// Faces of third order where few layers of hexahedra or prisms bend, in plane meshes (plane strain or stress). With the
// gradients of one ring (momentum.h) the slip between the faces across a beam and those along it is of first order in
// the curvature's derivative. Cells of length h_x in n layers of a body of thickness h bend as if it were stiffer
// by 1.5 (1
// - nu) (h_x/h)^2 and softer by (3 - 2/n)/n^2. Here each cell fits a cubic to its surroundings. Its faces take the mean
//   of the cubic's gradient over the face in place of the cell's gradient. They take its displacement at the face's
//   centre in place of the linear one. A field that is cubic, as that of a beam under an end load (Barre de
//   Saint-Venant), then is exact, whatever the shape of the cells. After the third-order cell-centred scheme of
//   Batistic, Castrillo, Cardiff, arXiv 2601.18417.
//
// Samples: fit_surroundings.h. Weight |xi|^-6, xi being distances in units of the cell's edges. What the samples do not
// tell from lower powers is left out.
//
// Damage: the fit counts as much as the stiffness factors of its cells agree, none if one has less than three quarters
// of another's. A broken layer thus remains as exact as it is with the gradients of one ring.

#include "mesh/mesh.h"
#include "solver/momentum/body/unknowns.h"

#include <vector>

namespace pfdm {

class CubicFaces {
 public:
  /// One side of a face.
  struct Side {
    Index cell = 0, face = 0;
  };
  /// Difference of the fit at a side from the cell's gradient G [-], and from G d, d = x_f - x_c [m].
  struct Change {
    Tensor gradient = Tensor::Zero();
    Vector rise = Vector::Zero();
  };

  CubicFaces() = default;
  /// Fits for the given sides of cells whose layers bend (bending_layers.h, slender_layers.h); none in space or about
  /// an axis.
  CubicFaces(const Mesh& mesh, const Unknowns& unknowns, const std::vector<Side>& sides);

  bool any() const { return !cells_.empty(); }
  /// Whether a cell has a fit, whatever it counts.
  bool fits(Index cell) const { return any() && has_fit_[cell] != 0; }
  /// Weighs each fit by the stiffness factors g.
  void weigh(const CellField<double>& g);
  /// Finds the changes, by the number of the side, of the displacements u and their gradients in the cells. Sides of
  /// cells without fits are left alone.
  void read(const std::vector<Vector>& u, const CellField<Tensor>& gradients, std::vector<Change>& changes) const;

 private:
  struct Cell {
    Index cell = 0;
    std::size_t first_sample = 0, n_samples = 0, first_side = 0, n_sides = 0, first_coefficient = 0;
    double weight = 1.0;
  };
  // Coefficients of a sample in the mean gradient over a face [1/m], and in the displacement at its centre [-].
  struct Coefficient {
    Vector gradient;
    double value;
  };

  std::vector<Cell> cells_;
  CellField<char> has_fit_;
  std::vector<Index> samples_;
  std::vector<std::size_t> side_numbers_;
  std::vector<Vector> to_face_;            // per entry of side_numbers_: x_f - x_c [m]
  std::vector<Coefficient> coefficients_;  // of each cell: side by side, sample by sample
  Index n_cells_ = 0;
};

}  // namespace pfdm
