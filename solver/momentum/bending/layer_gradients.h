#pragma once
// Gradients of bodies in layers of hexahedra that bend, of third order along the lines of cells through opposite faces:
// of vibrating ones, others in space, about an axis, and at finite strain also in plane meshes.
//
// With the gradients of one ring (momentum.h) n layers leave out the bending within each of them, (3 - 2/n)/n^2 of the
// stiffness, less in torsion. The jump term of the faces across the span adds 1.5 (1 - nu) (h_x/h)^2 in cells of length
// h_x. Slopes by differences over two cells are too small by a sixth of (wave number times h_x)^2. A cubic fit to all
// cells around (cubic_faces.h) cures plane meshes, but makes torsion too stiff where cells along free edges are longer
// than the thickness. Lines of cells do not:
//
// 1. The derivative of a cell along each of its lines is the mean over the cell of the polynomial through the slopes
//    between the centres of the line's cells, four of them, three beside a surface. Slopes of half cells at free
//    surfaces follow from tractions, and are taken to be those at the surface; those of components that are held are
//    those of the middle of the half cell.
// 2. On free surfaces across the layers, at free ends of lines and on planes of symmetry at their ends, derivatives
//    along the surface are extrapolated from the centres of the last two cells. (Else Poisson's effect across a plate
//    is that of the cells' centres: 15 % of the stiffness with four layers at nu = 0.45; and a moment at a free end
//    bends 1 to 5 % too little. At free ends this fades in cells 1 to 1.5 times as long as the body is thick.) On
//    interfaces between bonded layers of two materials those along them are between the two centres, or by either side
//    alone where one is more than three times as stiff and has a cell behind it, and the derivative across follows from
//    the slopes of the half cell and the next step. So it does of components that are held at the end of a line. A
//    laminate then bends exactly.
// 3. Of the jump at faces across the span the component across the layers has the weight 0.04/(1 - nu) t h/d^2, t being
//    the thickness of the layer, h that of all and d the distance of the cells' centres: 0.06/n of the stiffness is
//    left. The others keep theirs; so twisting shears the faces beside free edges in full.
//
// 4. Where the elasticity shears the layers under stresses along them, derivatives along the layers vary across them
//    more than linearly (layer_curvature.h).
//
// Linear fields remain exact. Split faces are free surfaces whose node moves.
//
// Damage: the lines of a cell count as much as the stiffness factors of the cells on them agree, none if one has less
// than three quarters of another's. A jump counts as that of one ring does by the lesser of both cells.

#include "mesh/mesh.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/cubic_faces.h"
#include "solver/momentum/bending/layer_curvature.h"
#include "solver/momentum/bending/line_weights.h"
#include "solver/momentum/body/momentum_faces.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <vector>

namespace pfdm {

class LayerGradients {
 public:
  /// Which sides have derivatives of their own, by 2.: free surfaces across the layers and planes of symmetry alone, or
  /// also free ends of lines and interfaces.
  enum class OwnSides { surfaces, surfaces_ends_and_interfaces };

  LayerGradients() = default;
  /// Gradients of these cells, the entries of one cell one after the other (bending_layers.h). Sides 2 i and 2 i + 1
  /// are those of link number i.
  LayerGradients(const Mesh& mesh, const Unknowns& unknowns, const std::vector<CubicFaces::Side>& sides,
                 const std::vector<momentum_faces::Link>& links, const std::vector<BendingCell>& cells,
                 OwnSides own = OwnSides::surfaces_ends_and_interfaces);

  bool any() const { return counts_; }
  /// Whether some cells have lines, whatever they count.
  bool has_lines() const { return !cells_.empty(); }
  /// Whether a cell has lines, whatever they count.
  bool cover(Index cell) const { return any() && is_covered_[cell] != 0; }
  /// Weight of the lines of a cell, 0 to 1; 0 without any.
  double counts(Index cell) const { return cover(cell) ? counting_[cell] : 0.0; }
  /// Weighs the lines of each cell by the stiffness factors g.
  void weigh(const CellField<double>& g);
  /// Whether the jump at a link has a weight of its own.
  bool weighs(std::size_t link) const { return any() && is_weighed_[link] != 0; }
  /// Turns the gradients of one ring of the displacements u into those along the lines. Finds the difference of the
  /// gradient at a side, by its number, from that of the cell; sides where there is none are left alone.
  void correct(const std::vector<Vector>& u, CellField<Tensor>& gradients, std::vector<Tensor>& changes) const;
  /// Variation of a field of the cells, as their gradient, along one of a cell's lines: the root of its mean square
  /// over the cell.
  template <class Value>
  Value spread(Index line, const CellField<Value>& of_cells) const {
    const Line& on = lines_[line];
    return on.spread * (of_cells[on.after] - of_cells[on.before]);
  }
  /// Calls see(cell, how much its lines count, the first of its lines, the one behind the last) of all cells with
  /// lines.
  template <class See>
  void each_cell(const See& see) const;
  /// The sides, by their numbers, whose gradients differ from those of their cells.
  std::vector<std::size_t> surface_sides() const;
  /// Extrapolates a field of the cells, as their eigenstrains, to these sides where it is linear along the line: calls
  /// see(side, cell, the next cell inwards, the part of the difference of both that the field at the side differs by).
  template <class See>
  void extrapolate(const See& see) const;
  /// LayerCurvature::lean() of a link, as much as the lines of both cells count [m].
  double lean(std::size_t link) const {
    const double sound = curvature_.lean(link);
    const auto& [P, N] = cells_of_link_[link];
    return sound == 0.0 ? 0.0 : sound * std::min(counting_[P], counting_[N]);
  }
  /// The weights of the components of the jump at a link.
  const Tensor& weight(std::size_t link) const { return weights_[link]; }

 private:
  // Difference of two unknowns.
  struct Slope {
    std::size_t from, to;
    Vector step;                // [m]
    double weight_over_length;  // in the mean, [1/m]
  };
  // The line through a cell, up to two cells on either side of it.
  struct Line {
    Vector along;  // the gradient changes by (mean slope - its own along the line) (x) along
    std::size_t first_slope, end_slope;
    std::size_t first_held, end_held;
    Index before, after;  // the cells beside this one, itself where there is none
    double spread;        // of a cell's length over twelve's root and the distance of these two
  };
  struct Cell {
    Index cell;
    std::size_t first_line, end_line;
    double weight = 1.0;
  };
  // A side with a gradient of its own, and the next cell of its line inwards, or the one bonded to it.
  struct Surface {
    Index cell, next;
    double ratio;         // distance of the surface from the cell's centre, over that of the two centres; negative
                          // if the other one lies beyond it; a part of that at free ends of long cells
    Index behind;         // the next one inwards, -1: none,
    double behind_ratio;  // and the ratio of that one
    Vector n;
    std::size_t side;
    std::size_t first_slope, end_slope;  // of bonded and held ones, else none: this part of their sum is what the slope
    Tensor of_slopes;                    // along the line changes by to the surface,
    Tensor across;                       // of these components
    Vector along;
    double weight = 1.0;
  };

  class Maker;

  double least_factor_ratio(const Cell& in, const CellField<double>& g) const;
  static double part_of(double factor_ratio);  // weight where the least factor over the greatest is this

  std::vector<Cell> cells_;
  std::vector<Line> lines_;
  std::vector<Slope> slopes_;
  std::vector<LineWeights::Change> held_;  // of the lines, over the lengths of their slopes [1/m]
  std::vector<Surface> surfaces_;
  LayerCurvature curvature_;
  std::vector<Tensor> sound_weights_, weights_;  // per link [-]
  std::vector<std::array<Index, 2>> cells_of_link_;
  CellField<double> counting_;  // weight of each cell's lines, 1 where it has none
  CellField<char> is_covered_;
  bool counts_ = false;
  std::vector<char> is_weighed_;
};

template <class See>
void LayerGradients::each_cell(const See& see) const {
  parallel_for(count_of(cells_), [&](Index i) {
    const Cell& in = cells_[i];
    see(in.cell, in.weight, static_cast<Index>(in.first_line), static_cast<Index>(in.end_line));
  });
}

template <class See>
void LayerGradients::extrapolate(const See& see) const {
  parallel_for(count_of(surfaces_), [&](Index i) {
    const Surface& at = surfaces_[i];
    if (at.behind >= 0) see(at.side, at.cell, at.behind, at.weight * at.behind_ratio);
  });
}

}  // namespace pfdm
