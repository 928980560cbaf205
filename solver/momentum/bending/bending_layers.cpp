#include "solver/momentum/bending/bending_layers.h"

#include "physics/elasticity/anisotropy.h"
#include "solver/momentum/bending/body_ends.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

// A pair of opposite faces.
struct OppositeFaces {
  std::array<Index, 2> face{-1, -1};
};

bool touch(const Mesh& mesh, Index f, Index g) {
  const auto a = mesh.points_of_face(f), b = mesh.points_of_face(g);
  return std::any_of(a.begin(), a.end(), [&](Index p) { return std::find(b.begin(), b.end(), p) != b.end(); });
}

// A line of cells through opposite faces. Ends may be free, planes of symmetry, or neither: held, or beside other
// cells. Rollers at rest are held across alone, as planes of symmetry are.
struct LayerLine {
  double n = 0.0, length = 0.0;
  int n_mirrors = 0, n_held = 0, n_resting = 0;
  std::size_t stack = 0;  // of LayerLines, if it has layers

  double times() const { return n_mirrors == 1 ? 2.0 : 1.0; }
  // Cells between the free surfaces on both sides. Nothing bends between two rollers at rest, as in plane strain.
  bool has_layers() const { return n_held == 0 && n_mirrors < 2 && n_resting < 2; }
};

class LayerLines {
 public:
  LayerLines(const Mesh& mesh, const Unknowns& unknowns)
      : mesh_(mesh),
        unknowns_(unknowns),
        ends_(body_ends(mesh, unknowns)),
        rests_(resting_rollers(mesh, unknowns)),
        pairs_(mesh.n_cells()) {
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      lines_.emplace_back();
      pairs_[c] = pairs_of(c);
    }
    for (Index c = 0; c < mesh.n_cells(); ++c)
      for (int axis = 0; axis < n_axes(c); ++axis)
        if (lines_[c][axis].n == 0.0) walk(c, axis);
  }

  /// Three of a hexahedron, two in a plane mesh; one of a prism, across its triangles.
  int n_axes(Index cell) const {
    int n = 0;
    for (const OppositeFaces& pair : pairs_[cell]) n += pair.face[0] >= 0 ? 1 : 0;
    return n;
  }
  const std::array<Index, 2>& faces(Index cell, int axis) const { return pairs_[cell][axis].face; }
  const LayerLine& line(Index cell, int axis) const { return lines_[cell][axis]; }
  /// Of the layers of a line, as they bend along another axis of one of its cells.
  const LayerStack& stack(const LayerLine& line, Index cell, int across, int along) {
    Stack& of = stacks_[line.stack];
    if (!unknowns_.stiffness) return of.bends;
    const Vector direction = direction_of(cell, along);
    if (std::abs(of.along.dot(direction)) < 1.0 - 1e-9) {
      const Vector normal = direction_of(cell, across);
      for (StackLayer& layer : of.layers)
        if (const MandelMatrix* C = unknowns_.stiffness_of(mesh_, layer.cell))
          layer.modulus = DirectedStrip(*C, direction, normal).modulus;
      of.bends = layer_stack(of.layers, of.is_mirrored);
      of.along = direction;
    }
    return of.bends;
  }
  /// BendingLayers::shear of a cell.
  double shear(Index cell, int across, int along) const {
    const MandelMatrix* C = unknowns_.stiffness_of(mesh_, cell);
    const Vector normal = direction_of(cell, across);
    if (C == nullptr || is_symmetric_about(*C, normal)) return 0.0;
    const DirectedStrip strip(*C, direction_of(cell, along), normal);
    return strip.shear_held / strip.modulus;
  }
  Vector direction_of(Index cell, int axis) const {
    const auto& [from, to] = pairs_[cell][axis].face;
    return (mesh_.face_centre[to] - mesh_.face_centre[from]).normalized();
  }
  /// Length of the cells of one zone in the line, twice that where one of its ends is a plane of symmetry [m].
  double zone_length(Index cell, int axis) const {
    double sum = length(cell, axis);
    std::array<Index, 2> ends = faces(cell, axis);
    along_line(
        mesh_, cell, faces(cell, axis),
        [&](Index at, Index face) { return unknowns_.node_beside(mesh_, at, face) >= 0; },
        [&](Index near, Index far) {
          sum += (mesh_.face_centre[far] - mesh_.face_centre[near]).norm();
          (near == ends[0] ? ends[0] : ends[1]) = far;
        });
    const auto is_mirror = [&](Index face) { return !mesh_.is_interior(face) && ends_[face] == BodyEnd::mirror; };
    return is_mirror(ends[0]) != is_mirror(ends[1]) ? 2.0 * sum : sum;
  }
  double length(Index cell, int axis) const {
    const auto& [f, g] = pairs_[cell][axis].face;
    return (mesh_.face_centre[g] - mesh_.face_centre[f]).norm();
  }

 private:
  using Step = std::pair<Index, int>;

  // The layers across a body. Where the elasticity depends on the direction, `bends` is that along this one.
  struct Stack {
    std::vector<StackLayer> layers;
    bool is_mirrored = false;
    LayerStack bends{};
    Vector along = Vector::Zero();
  };

  // Pairs of opposite faces, those within the plane of a plane mesh first; the pair across it is left out.
  std::array<OppositeFaces, 3> pairs_of(Index cell) const {
    std::array<OppositeFaces, 3> pairs;
    std::size_t n = 0;
    for (const Index f : mesh_.faces_of_cell(cell)) {
      const Index g = opposite_face(mesh_, cell, f);
      if (g < f || is_beside_plane(f) || is_beside_plane(g)) continue;
      if (n < 3) pairs[n++].face = {f, g};
    }
    return pairs;
  }
  bool is_beside_plane(Index face) const { return !mesh_.is_interior(face) && unknowns_.node_of_face[face] < 0; }

  void walk(Index cell, int axis) {
    std::vector<Step> steps{{cell, axis}};
    LayerLine line;
    bool mirror_is_first = false;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      if (side == 1) std::ranges::reverse(steps);  // from one end of the line to the other
      const auto [end, rests] = follow(cell, pairs_[cell][axis].face[side], steps);
      line.n_mirrors += end == BodyEnd::mirror ? 1 : 0;
      line.n_resting += rests ? 1 : 0;
      line.n_held += end == BodyEnd::held ? 1 : 0;
      mirror_is_first |= side == 0 && end == BodyEnd::mirror;
    }
    for (const auto& [c, a] : steps) {
      line.n += 1.0;
      line.length += length(c, a);
    }
    if (line.has_layers()) {
      line.stack = stacks_.size();
      if (mirror_is_first) std::ranges::reverse(steps);
      stacks_.push_back({.layers = layers_of(steps), .is_mirrored = line.n_mirrors == 1});
      stacks_.back().bends = layer_stack(stacks_.back().layers, stacks_.back().is_mirrored);
    }
    for (const auto& [c, a] : steps) lines_[c][a] = line;
  }

  std::vector<StackLayer> layers_of(const std::vector<Step>& steps) const {
    std::vector<StackLayer> layers;
    layers.reserve(steps.size());
    for (const auto& [c, a] : steps)
      layers.push_back({.cell = c,
                        .zone = unknowns_.zone[c],
                        .thickness = length(c, a),
                        .modulus = plate_modulus(unknowns_.sound[unknowns_.zone[c]])});
    return layers;
  }

  // Adds the cells beyond a face. What they end at, and whether that is a roller at rest.
  std::pair<BodyEnd, bool> follow(Index cell, Index face, std::vector<Step>& steps) const {
    const Index first = cell;
    while (mesh_.is_interior(face) && !unknowns_.is_split(face)) {
      cell = mesh_.across(face, cell);
      if (cell == first) return {BodyEnd::held, false};
      const int axis = axis_of(cell, face);
      if (axis < 0) return {BodyEnd::held, false};
      steps.emplace_back(cell, axis);
      const auto& ends = pairs_[cell][axis].face;
      face = ends[0] == face ? ends[1] : ends[0];
    }
    if (mesh_.is_interior(face)) return {BodyEnd::free, false};
    return {ends_[face], rests_[face] != 0};
  }
  int axis_of(Index cell, Index face) const {
    for (int a = 0; a < n_axes(cell); ++a)
      for (const Index f : pairs_[cell][a].face)
        if (f == face) return a;
    return -1;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  FaceField<BodyEnd> ends_;
  FaceField<char> rests_;
  std::vector<std::array<OppositeFaces, 3>> pairs_;
  std::vector<std::array<LayerLine, 3>> lines_;
  std::vector<Stack> stacks_;
};

// Cells in the line of a cell up to faces at which it ends.
template <class Ends>
Index count_through(const Mesh& mesh, Index cell, const std::array<Index, 2>& faces, const Ends& ends) {
  Index n = 1;
  along_line(mesh, cell, faces, ends, [&](Index, Index) { ++n; });
  return n;
}

// see(cell with its faces, layers, nu) of the layers across each body that is long enough, at each of its cells, for
// each direction in which it is.
template <class See>
void over_layers(const Mesh& mesh, const Unknowns& unknowns, const See& see) {
  if (unknowns.motion.any() || !unknowns.periodic.empty()) return;
  LayerLines lines(mesh, unknowns);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (int across = 0; across < lines.n_axes(c); ++across)
      for (int along = 0; along < lines.n_axes(c); ++along) {
        const LayerLine &layers = lines.line(c, across), &length = lines.line(c, along);
        const double n = layers.times() * layers.n, thickness = layers.times() * layers.length;
        if (across == along || !layers.has_layers()) continue;
        if (length.times() * length.length < BendingLayers::least_slenderness * thickness) continue;
        see(BendingCell{.cell = c,
                        .across = lines.faces(c, across),
                        .along = lines.faces(c, along),
                        .thickness = thickness,
                        .zone_thickness = lines.zone_length(c, across)},
            BendingLayers{.n = n,
                          .thickness = thickness,
                          .length = lines.length(c, along),
                          .stack = lines.stack(layers, c, across, along),
                          .shear = lines.shear(c, across, along)},
            unknowns.sound[unknowns.zone[c]].poisson_ratio());
      }
}

double error_of(const BendingLayers& at, BendBy by, bool are_long, bool is_about_axis, double nu) {
  if (by == BendBy::lines) return at.error_of_lines(nu);
  return by == BendBy::cubics ? at.error_of_cubics(are_long) : at.error_of_one_ring(nu, is_about_axis);
}

}  // namespace

Index opposite_face(const Mesh& mesh, Index cell, Index face) {
  const CellShape shape = mesh.shape[cell];
  if (shape != CellShape::hexahedron && shape != CellShape::wedge) return -1;
  for (const Index f : mesh.faces_of_cell(cell))
    if (!touch(mesh, f, face)) return f;
  return -1;
}

std::vector<BendingCell> cells_of_layers(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<BendingCell> cells;
  over_layers(mesh, unknowns, [&](const BendingCell& in, const BendingLayers&, double) { cells.push_back(in); });
  return cells;
}

Index cells_through(const Mesh& mesh, const Unknowns& unknowns, Index cell, const std::array<Index, 2>& faces) {
  return count_through(mesh, cell, faces,
                       [&](Index at, Index face) { return unknowns.node_beside(mesh, at, face) >= 0; });
}

bool has_lines(const Mesh& mesh, const Unknowns& unknowns, const BendingCell& in, LinesIn where) {
  if (where == LinesIn::space && !unknowns.plane_normal.isZero()) return false;
  return count_through(mesh, in.cell, in.across, [&](Index, Index face) { return unknowns.is_split(face); }) >= 2;
}

std::vector<BendingCell> cells_with_lines(const Mesh& mesh, const Unknowns& unknowns, LinesIn where) {
  std::vector<BendingCell> cells;
  if (where == LinesIn::space && !unknowns.plane_normal.isZero()) return cells;
  over_layers(mesh, unknowns, [&](const BendingCell& in, const BendingLayers& at, double nu) {
    if (at.is_wrong(nu) && has_lines(mesh, unknowns, in, where)) cells.push_back(in);
  });
  return cells;
}

std::vector<char> bending_cells(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<char> bends(mesh.n_cells(), 0);
  over_layers(mesh, unknowns, [&](const BendingCell& in, const BendingLayers& at, double nu) {
    if (at.is_wrong(nu)) bends[in.cell] = 1;
  });
  return bends;
}

std::optional<BendingError> largest_bending_error(const Mesh& mesh, const Unknowns& unknowns, BendBy by) {
  constexpr double bearable = 0.03;  // of cubics in long cells, which err only where they are the rule
  double all = 0.0, too_long = 0.0;  // volumes
  std::array<std::optional<BendingError>, 2> largest;  // long cells are the exception; the rule
  over_layers(mesh, unknowns, [&](const BendingCell& in, const BendingLayers& at, double nu) {
    all += mesh.cell_volume[in.cell];
    if (at.excess_of_cubics() > bearable) too_long += mesh.cell_volume[in.cell];
    const bool is_several = by != BendBy::one_ring && has_lines(mesh, unknowns, in, LinesIn::space_and_plane);
    if (by == BendBy::cubics && !is_several) return;
    const BendBy by_now = is_several ? by : BendBy::one_ring;
    for (const bool are_long : {false, true}) {
      std::optional<BendingError>& found = largest[are_long ? 1 : 0];
      const double error = error_of(at, by_now, are_long, unknowns.is_axisymmetric(), nu);
      if (!found || std::abs(error) > std::abs(found->error))
        found = {.cell = in.cell, .layers = at, .poisson_ratio = nu, .error = error, .by = by_now};
    }
  });
  return largest[too_long > 0.5 * all ? 1 : 0];
}

}  // namespace pfdm
