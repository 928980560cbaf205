#pragma once
// Layers of few cells that bend: lines of cells through opposite faces, and the bending error of gradients of one ring.

#include "mesh/mesh.h"
#include "solver/momentum/bending/axes_turn.h"
#include "solver/momentum/bending/layer_stack.h"
#include "solver/momentum/body/unknowns.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace pfdm {

/// Layers across a body at a cell, and the cell's longest edge along them.
struct BendingLayers {
  /// Length over thickness from which on a body is taken to bend: three, less what rounding of coordinates may take.
  static constexpr double least_slenderness = 3.0 * (1.0 - 1e-6);

  double n = 0.0;          ///< layers, twice as many where the last one lies on a plane of symmetry
  double thickness = 0.0;  ///< of all of them [m]
  double length = 0.0;     ///< of the cell along the layers [m]
  LayerStack stack;        ///< of all of them
  /// Where strains within the layers shear them: C_ss of the shear angle times the compliance of the stress along [-].
  /// Zero elsewhere.
  double shear = 0.0;
  AxesTurn turn{};

  /// Bending stiffness with gradients of one ring over the exact one: 1.5 (1 - nu) (length/thickness)^2 too much, and
  /// (3 - 2/n)/n^2 too little.
  double excess(double nu) const { return 1.5 * (1.0 - nu) * length * length / (thickness * thickness); }
  double lack() const { return n > 1.0 ? (3.0 - 2.0 / n) / (n * n) : 1.0; }
  /// Whether either exceeds half a per cent.
  bool is_wrong(double nu) const { return std::max(excess(nu), lack()) > 0.005; }
  // Bending stiffness over the exact one, less 1, of stacks of one or several materials (LayerStack). Measured with
  // cantilevers (bending.md, tests `bending_in_space` and `laminates`).
  //
  /// The excess of the stack's even thickness, x = 1.5 (1 - nu) (length/even_thickness)^2.
  double excess_of_stack(double nu) const;
  /// Gradients of one ring, too much by long cells: x/(1 + 0.13 x^1.5).
  double excess_of_one_ring(double nu) const;
  /// Likewise, too little: (3 - 2/n - 0.6 f (2 - 3/n)) (layers - lone) + lone, n = layers^(-1/2) and f = nu^2/((1 - nu)
  /// (1 - 2 nu)) at nu up to 0.45, which is how Poisson's effect across stiffens layers.
  double lack_of_one_ring(double nu) const;
  /// The difference of both; about an axis the larger of them, as only the radial part of the bending has the excess.
  double error_of_one_ring(double nu, bool is_about_axis) const;
  /// Gradients along lines of cells that are longer than the thickness: 0.05 (length/thickness - 1)^1.3 sqrt((1 -
  /// nu)/(1 - 2 nu)), nu at most 0.45, too much in cantilevers of an even number of cells, too little with an odd one.
  /// In layers that are sheared 0.11 shear^(1/2) for the factors before and behind.
  double excess_of_lines(double nu) const;
  /// Materials of one or two cells across, too little: 0.65 lone + 0.06 beside + 0.14 between.
  double lack_of_lines() const { return 0.65 * stack.lone + 0.06 * stack.beside + 0.14 * stack.between; }
  /// Three or more uneven layers of a single material, too much: d/(1 + 6 d), d = layers - 1/n^2.
  double excess_of_uneven() const;
  /// The larger of the two, too much, where they exceed what is lacking, else that; a laminate's are added. Or that of
  /// axes that turn, if it is larger.
  double error_of_lines(double nu) const;
  double error_of_turn() const;
  bool is_by_turn(double nu) const { return error_of_turn() > 0.0 && error_of_lines(nu) == error_of_turn(); }
  /// Cubic fits in plane meshes, either way: c (length/thickness)^3 thickness/even_thickness, c = 0.005 + 0.014
  /// of_pairs of laminates, and 0.019 of two layers of a single material; zero of more.
  double excess_of_cubics() const;
  /// Materials of one cell across in plane meshes, too little: 0.9 lone (1 + 0.12 (length/thickness)^2).
  double lack_of_cubics() const;
  /// The larger of the two; that of long cells only where they are the rule.
  double error_of_cubics(bool are_long) const;
};

/// nu^2/((1 - nu)(1 - 2 nu)), at nu up to 0.45: how much Poisson's effect stiffens layers that do not see it.
double poisson_share(double nu);

/// E/(1 - nu^2) [Pa].
double plate_modulus(const IsotropicElasticity& of);

/// A strip in plane strain along the unit vectors `along` and `across` its layers, whose elasticity C depends on the
/// direction; a: the strain along it, s: the shear angle.
struct DirectedStrip {
  double modulus = 0.0;          ///< of the stress along it, E/(1 - nu^2) if isotropic [Pa]
  double shear_held = 0.0;       ///< C_ss [Pa]
  double shear_stiffness = 0.0;  ///< C_ss - C_as^2/C_aa [Pa]
  double shear_by_strain = 0.0;  ///< R of AxesTurn [-]

  DirectedStrip(const MandelMatrix& C, const Vector& along, const Vector& across);
};

/// The face of a hexahedron opposite to one of its faces, or a prism's other triangle; else -1.
Index opposite_face(const Mesh& mesh, Index cell, Index face);

/// Calls see(near face, far face) of every other cell in the line of a cell through these opposite faces, outwards, up
/// to faces at which it ends: ends(cell before the face, face).
template <class Ends, class See>
void along_line(const Mesh& mesh, Index cell, const std::array<Index, 2>& faces, const Ends& ends, const See& see) {
  for (Index face : faces)
    for (Index at = cell; mesh.is_interior(face) && !ends(at, face);) {
      at = mesh.across(face, at);
      const Index far = opposite_face(mesh, at, face);
      if (far < 0 || at == cell) break;
      see(face, far);
      face = far;
    }
}

/// A cell of layers that bend: its two faces across which the layers lie one on another, and the two that the length of
/// the body runs through.
struct BendingCell {
  Index cell = 0;
  std::array<Index, 2> across{-1, -1}, along{-1, -1};
  double thickness = 0.0;       ///< of all layers, of half models that of the whole body [m]
  double zone_thickness = 0.0;  ///< of the layers of the cell's own zone [m]
};

/// Calls see(entries of one cell) of all cells, whose entries follow one another.
template <class See>
void over_cells(std::span<const BendingCell> cells, const See& see) {
  for (std::size_t first = 0, end = 0; first < cells.size(); first = end) {
    while (end < cells.size() && cells[end].cell == cells[first].cell) ++end;
    see(cells.subspan(first, end - first));
  }
}

/// All cells of bodies at least three times as long as thick, whatever the error; a cell of a plate is listed for both
/// directions in which the plate is long. None in boxes that follow a mean strain.
std::vector<BendingCell> cells_of_layers(const Mesh& mesh, const Unknowns& unknowns);

/// Cells of one elastic zone in the line of a cell through two opposite faces, split faces being ends.
Index cells_through(const Mesh& mesh, const Unknowns& unknowns, Index cell, const std::array<Index, 2>& faces);

/// Meshes in which layers that bend have gradients along lines of cells (layer_gradients.h).
enum class LinesIn { space, space_and_plane };

/// Whether a cell has them: with at least two cells across, which may be of several zones that are bonded.
bool has_lines(const Mesh& mesh, const Unknowns& unknowns, const BendingCell& in, LinesIn where);

/// Cells of cells_of_layers() that have lines and that gradients of one ring would bend with an error of more than half
/// a per cent.
std::vector<BendingCell> cells_with_lines(const Mesh& mesh, const Unknowns& unknowns, LinesIn where);

/// Per cell, nonzero for hexahedra in bodies at least three times as long as thick whose layers would bend with an
/// error of more than half a per cent. None in boxes that follow a mean strain.
std::vector<char> bending_cells(const Mesh& mesh, const Unknowns& unknowns);

/// By which gradients layers bend.
enum class BendBy : char { one_ring, lines, cubics };

/// The error of bending at a cell.
struct BendingError {
  Index cell = 0;
  BendingLayers layers;
  double poisson_ratio = 0.0;
  double error = 0.0;  ///< bending stiffness over the exact one, less 1; of long cells with cubic fits either way
  BendBy by = BendBy::one_ring;
};

/// Largest bending error of hexahedra in bodies at least three times as long as thick; empty without such bodies. `by`:
/// what they have that are two or more across; bodies of a single cell across have one ring, of which cubics say
/// nothing. Cells of cubic fits are long where those of half of the volume or more err by 3 %. None in boxes that
/// follow a mean strain.
std::optional<BendingError> largest_bending_error(const Mesh& mesh, const Unknowns& unknowns,
                                                  BendBy by = BendBy::one_ring);

/// Of the bodies at least three times as long as thick whose material axes turn across their layers the one of the
/// fewest layers, at a cell of it; empty without such bodies.
struct TurnedLayers {
  Index cell = 0;
  BendingLayers layers;
};
std::optional<TurnedLayers> fewest_turned_layers(const Mesh& mesh, const Unknowns& unknowns);

}  // namespace pfdm
