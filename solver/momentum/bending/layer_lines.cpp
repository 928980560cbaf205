#include "solver/momentum/bending/layer_lines.h"

#include "physics/elasticity/anisotropy.h"

#include <algorithm>

namespace pfdm {

LayerLines::LayerLines(const Mesh& mesh, const Unknowns& unknowns)
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

int LayerLines::n_axes(Index cell) const {
  int n = 0;
  for (const std::array<Index, 2>& pair : pairs_[cell]) n += pair[0] >= 0 ? 1 : 0;
  return n;
}

const LayerLines::Stack& LayerLines::stack(const LayerLine& line, Index cell, int across, int along) {
  Stack& of = stacks_[line.stack];
  if (!unknowns_.stiffness) return of;
  const Vector direction = direction_of(cell, along);
  if (std::abs(of.along.dot(direction)) < 1.0 - 1e-9) direct(of, direction, direction_of(cell, across));
  return of;
}

double LayerLines::shear(Index cell, int across, int along) const {
  const MandelMatrix* C = unknowns_.stiffness_of(mesh_, cell);
  const Vector normal = direction_of(cell, across);
  if (C == nullptr || is_symmetric_about(*C, normal)) return 0.0;
  const DirectedStrip strip(*C, direction_of(cell, along), normal);
  return strip.shear_held / strip.modulus;
}

Vector LayerLines::direction_of(Index cell, int axis) const {
  const auto& [from, to] = pairs_[cell][axis];
  return (mesh_.face_centre[to] - mesh_.face_centre[from]).normalized();
}

double LayerLines::zone_length(Index cell, int axis) const {
  double sum = length(cell, axis);
  std::array<Index, 2> ends = faces(cell, axis);
  along_line(
      mesh_, cell, faces(cell, axis), [&](Index at, Index face) { return unknowns_.node_beside(mesh_, at, face) >= 0; },
      [&](Index near, Index far) {
        sum += (mesh_.face_centre[far] - mesh_.face_centre[near]).norm();
        (near == ends[0] ? ends[0] : ends[1]) = far;
      });
  const auto is_mirror = [&](Index face) { return !mesh_.is_interior(face) && ends_[face] == BodyEnd::mirror; };
  return is_mirror(ends[0]) != is_mirror(ends[1]) ? 2.0 * sum : sum;
}

double LayerLines::length(Index cell, int axis) const {
  const auto& [f, g] = pairs_[cell][axis];
  return (mesh_.face_centre[g] - mesh_.face_centre[f]).norm();
}

void LayerLines::direct(Stack& of, const Vector& along, const Vector& across) const {
  std::vector<TurnedLayer> turned;
  for (StackLayer& layer : of.layers) {
    const MandelMatrix* C = unknowns_.stiffness_of(mesh_, layer.cell);
    if (C == nullptr) continue;
    const DirectedStrip strip(*C, along, across);
    layer.modulus = strip.modulus;
    turned.push_back({layer.zone, layer.thickness, strip.shear_by_strain});
  }
  of.bends = layer_stack(of.layers, of.is_mirrored);
  of.turn = axes_turn(turned, static_cast<bool>(unknowns_.loads.eigenstrain));
  of.along = along;
}

// Pairs of opposite faces, those within the plane of a plane mesh first; the pair across it is left out.
LayerLines::Pairs LayerLines::pairs_of(Index cell) const {
  Pairs pairs;
  pairs.fill({-1, -1});
  std::size_t n = 0;
  for (const Index f : mesh_.faces_of_cell(cell)) {
    const Index g = opposite_face(mesh_, cell, f);
    if (g < f || is_beside_plane(f) || is_beside_plane(g)) continue;
    if (n < 3) pairs[n++] = {f, g};
  }
  return pairs;
}

void LayerLines::walk(Index cell, int axis) {
  std::vector<Step> steps{{cell, axis}};
  LayerLine line;
  bool mirror_is_first = false;
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    if (side == 1) std::ranges::reverse(steps);  // from one end of the line to the other
    const auto [end, rests] = follow(cell, pairs_[cell][axis][side], steps);
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

std::vector<StackLayer> LayerLines::layers_of(const std::vector<Step>& steps) const {
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
std::pair<BodyEnd, bool> LayerLines::follow(Index cell, Index face, std::vector<Step>& steps) const {
  const Index first = cell;
  while (mesh_.is_interior(face) && !unknowns_.is_split(face)) {
    cell = mesh_.across(face, cell);
    if (cell == first) return {BodyEnd::held, false};
    const int axis = axis_of(cell, face);
    if (axis < 0) return {BodyEnd::held, false};
    steps.emplace_back(cell, axis);
    const auto& ends = pairs_[cell][axis];
    face = ends[0] == face ? ends[1] : ends[0];
  }
  if (mesh_.is_interior(face)) return {BodyEnd::free, false};
  return {ends_[face], rests_[face] != 0};
}

int LayerLines::axis_of(Index cell, Index face) const {
  for (int a = 0; a < n_axes(cell); ++a)
    for (const Index f : pairs_[cell][a])
      if (f == face) return a;
  return -1;
}

}  // namespace pfdm
