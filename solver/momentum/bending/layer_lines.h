#pragma once
// Lines of cells through opposite faces of hexahedra and prisms, from one end of a body to the other, and the layers
// that lie one on another along them.

#include "mesh/mesh.h"
#include "solver/momentum/bending/axes_turn.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/body_ends.h"
#include "solver/momentum/body/unknowns.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pfdm {

/// A line of cells through opposite faces. Ends may be free, planes of symmetry, or neither: held, or beside other
/// cells. Rollers at rest are held across alone, as planes of symmetry are.
struct LayerLine {
  double n = 0.0, length = 0.0;
  int n_mirrors = 0, n_held = 0, n_resting = 0;
  std::size_t stack = 0;  ///< of LayerLines, if it has layers

  double times() const { return n_mirrors == 1 ? 2.0 : 1.0; }
  /// Cells between the free surfaces on both sides. Nothing bends between two rollers at rest, as in plane strain.
  bool has_layers() const { return n_held == 0 && n_mirrors < 2 && n_resting < 2; }
};

/// All lines of a mesh. An axis of a cell is one of its pairs of opposite faces, by number.
class LayerLines {
 public:
  /// The layers across a body. Where the elasticity depends on the direction, `bends` and `turn` are those along this
  /// one.
  struct Stack {
    std::vector<StackLayer> layers;
    bool is_mirrored = false;
    LayerStack bends{};
    AxesTurn turn{};
    Vector along = Vector::Zero();
  };

  LayerLines(const Mesh& mesh, const Unknowns& unknowns);

  /// Three of a hexahedron, two in a plane mesh; one of a prism, across its triangles.
  int n_axes(Index cell) const;
  const std::array<Index, 2>& faces(Index cell, int axis) const { return pairs_[cell][axis]; }
  const LayerLine& line(Index cell, int axis) const { return lines_[cell][axis]; }
  /// Of the layers of a line, as they bend along another axis of one of its cells.
  const Stack& stack(const LayerLine& line, Index cell, int across, int along);
  /// BendingLayers::shear of a cell.
  double shear(Index cell, int across, int along) const;
  /// Length of the cells of one zone in the line, twice that where one of its ends is a plane of symmetry [m].
  double zone_length(Index cell, int axis) const;
  double length(Index cell, int axis) const;

 private:
  using Step = std::pair<Index, int>;
  using Pairs = std::array<std::array<Index, 2>, 3>;  // of opposite faces; -1: none

  Vector direction_of(Index cell, int axis) const;
  // Its moduli and axes along this direction.
  void direct(Stack& of, const Vector& along, const Vector& across) const;
  Pairs pairs_of(Index cell) const;
  bool is_beside_plane(Index face) const { return !mesh_.is_interior(face) && unknowns_.node_of_face[face] < 0; }
  void walk(Index cell, int axis);
  std::vector<StackLayer> layers_of(const std::vector<Step>& steps) const;
  std::pair<BodyEnd, bool> follow(Index cell, Index face, std::vector<Step>& steps) const;
  int axis_of(Index cell, Index face) const;

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  FaceField<BodyEnd> ends_;
  FaceField<char> rests_;
  std::vector<Pairs> pairs_;
  std::vector<std::array<LayerLine, 3>> lines_;
  std::vector<Stack> stacks_;
};

}  // namespace pfdm
