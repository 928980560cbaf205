#pragma once
// How derivatives along layers that bend vary across them, beyond linearly: of materials whose elasticity depends on
// the direction, where strains within the layers shear them, as in wood with an inclined grain.
//
// Strains along such layers have a part of the parabola of the shear stress, which is the small difference of two large
// terms. Of a displacement of third order lines of cells (layer_gradients.h) give the derivative across the layers at
// the centre of a cell, and d^2/12 times its second derivative across, d being the thickness of the layer; the
// difference of two cells that at the face between them, and d^2/24 times it. A derivative along the layers is that of
// the centres: at a face the mean of both is off by d^2/8, at a free surface the linear extrapolation by -3 d^2/8.
// These parts add up to a stress that is none. A cantilever of four layers, E_1 = 14 E_2, fibres at 30 degrees, was 16
// % too stiff by them.
//
// So the derivatives along the layers take the same multiples of their own second derivatives across: d^2/12 on the
// faces that cut the layers, d^2/24 on those between two layers, none on free surfaces. These need three layers of one
// material.
//
// Between uneven layers the difference of two cells is the derivative half-way between their centres, and stresses of
// both count by their own distance from the face, those along it as of a place as far from the nearer cell as the face
// is from the other. Both are taken to the face, by the linear variation between the two cells. Else an error of the
// first order remains, a traction of C_as times the curvature times a quarter of the difference of both thicknesses:
// layers that grow by a twentieth each were 25 % too stiff.
//
// Where the material axes turn from layer to layer, all of these are those of the slope that derivatives along the
// layers make, too (turned_stiffness.h). And lines give the derivative across of the outermost cells with 19/288 d^2
// of its second derivative, as the slope at a free surface is that at a place.

#include "mesh/mesh.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/cubic_faces.h"

#include <array>
#include <span>
#include <vector>

namespace pfdm {

class LayerCurvature {
 public:
  LayerCurvature() = default;
  /// Of those of the cells whose layers are sheared, across the thinnest of the body at each cell; `cells` as of
  /// LayerGradients, as are the sides, of which its surfaces have a difference already.
  LayerCurvature(const Mesh& mesh, const Unknowns& unknowns, std::span<const CubicFaces::Side> sides,
                 const std::vector<BendingCell>& cells, std::span<const std::size_t> surfaces);

  /// `counts`: how much the lines of each cell count, 0 to 1.
  void weigh(const CellField<double>& counts);
  /// Adds to the differences of the gradients at the sides from those of their cells, or sets them.
  void add(const CellField<Tensor>& gradients, std::vector<Tensor>& changes) const;
  /// How far the face of a link between uneven layers is from half-way between both cells, in the direction from P to
  /// N [m]; zero of others.
  double lean(std::size_t link) const { return leans_.empty() ? 0.0 : leans_[link]; }

 private:
  // A multiple of the second derivative across at a side of a cell, from the differences to other cells.
  struct Change {
    std::size_t side;
    Index cell;
    std::array<Index, 3> others;  // -1: none
    std::array<double, 3> parts;  // [-]
    Vector across, dual;          // along this direction the derivative stays: G - G across dual^T
    double weight = 1.0;
  };
  // A slope across a side by the strain of another cell, whose axes are turned.
  struct Turn {
    std::size_t side;
    Index cell, other;
    Eigen::Matrix<double, 3, 6> slope;  // [-]
    Vector n;
    double weight = 1.0;
  };
  // All changes of a side, and all turns.
  struct OfSide {
    std::size_t side, first = 0, end = 0, first_turn = 0, end_turn = 0;
    bool has_other = false;
  };
  class Maker;

  void list_sides(std::size_t n_sides, std::span<const std::size_t> surfaces);

  std::vector<Change> changes_;  // ordered by sides
  std::vector<Turn> turns_;      // likewise
  std::vector<OfSide> sides_;
  std::vector<double> leans_;  // by links
};

}  // namespace pfdm
