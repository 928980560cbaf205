#include "solver/momentum/bending/bending_layers.h"

#include "solver/momentum/bending/layer_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

bool touch(const Mesh& mesh, Index f, Index g) {
  const auto a = mesh.points_of_face(f), b = mesh.points_of_face(g);
  return std::any_of(a.begin(), a.end(), [&](Index p) { return std::find(b.begin(), b.end(), p) != b.end(); });
}

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
        const LayerLines::Stack& stack = lines.stack(layers, c, across, along);
        see(BendingCell{.cell = c,
                        .across = lines.faces(c, across),
                        .along = lines.faces(c, along),
                        .thickness = thickness,
                        .zone_thickness = lines.zone_length(c, across)},
            BendingLayers{.n = n,
                          .thickness = thickness,
                          .length = lines.length(c, along),
                          .stack = stack.bends,
                          .shear = lines.shear(c, across, along),
                          .turn = stack.turn},
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

std::optional<TurnedLayers> fewest_turned_layers(const Mesh& mesh, const Unknowns& unknowns) {
  constexpr double least_range = 0.1;
  std::optional<TurnedLayers> found;
  over_layers(mesh, unknowns, [&](const BendingCell& in, const BendingLayers& at, double) {
    if (at.turn.range < least_range || (found && found->layers.n <= at.n)) return;
    found = {.cell = in.cell, .layers = at};
  });
  return found;
}

}  // namespace pfdm
