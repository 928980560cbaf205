#include "solver/momentum/bending/slender_layers.h"

#include "mesh/bounding_box.h"
#include "mesh/search/line_walk.h"
#include "solver/momentum/bending/body_ends.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

constexpr int n_directions = 8;  // in the plane of the layers, over half a turn

// Between the centres of a prism's triangles.
Vector axis_of(const Mesh& mesh, Index cell) {
  for (const Index f : mesh.faces_of_cell(cell))
    if (mesh.points_of_face(f).size() == 3)
      if (const Index g = opposite_face(mesh, cell, f); g >= 0)
        return (mesh.face_centre[g] - mesh.face_centre[f]).normalized();
  return Vector::Zero();
}

class SlenderSearch {
 public:
  SlenderSearch(const Mesh& mesh, const Unknowns& unknowns)
      : mesh_(mesh), unknowns_(unknowns), ends_(body_ends(mesh, unknowns)) {
    const Box box = bounding_box(mesh.points);
    size_ = (box.high - box.low).norm();
    is_mirrored_ = std::ranges::find(ends_, BodyEnd::mirror) != ends_.end();
  }

  std::optional<SlenderLayers> at(Index face) const {
    const Vector across = -mesh_.face_area[face].normalized();
    const Line through = walk(mesh_.owner[face], mesh_.face_centre[face], across, 2.0 * size_);
    if (through.face < 0 || through.end == BodyEnd::held) return std::nullopt;
    if (std::abs(mesh_.face_area[through.face].normalized().dot(across)) < 0.9) return std::nullopt;
    const auto other = std::ranges::find_if(
        through.segments, [&](const LineSegment& in) { return mesh_.shape[in.cell] != CellShape::hexahedron; });
    if (other == through.segments.end()) return std::nullopt;
    const double times = through.end == BodyEnd::mirror ? 2.0 : 1.0;
    const double least = BendingLayers::least_slenderness * times * through.length;
    if (least > (is_mirrored_ ? 2.0 : 1.0) * size_) return std::nullopt;
    const Vector centre = mesh_.face_centre[face] + 0.5 * through.length * across;
    std::optional<SlenderLayers> worst;
    for (const Vector& along : directions(across)) {
      if (!is_long(through.at(0.5 * through.length).cell, centre, along, least)) continue;
      const SlenderCells of = slender_cells(mesh_, other->cell, across, along);
      const BendingLayers layers = layers_of(of, through, across, along, times);
      if (worst && layers.length <= worst->layers.length) continue;
      worst = {.cell = mesh_.owner[face], .of = of, .along = along, .through = {}, .layers = layers};
    }
    if (worst)
      for (const LineSegment& in : through.segments) worst->through.push_back(in.cell);
    return worst;
  }

  bool is_free(Index face) const { return ends_[face] == BodyEnd::free && unknowns_.node_of_face[face] >= 0; }

 private:
  // Up to the face at which the body ends; no face where the length is reached before.
  struct Line {
    std::vector<LineSegment> segments;
    Index face = -1;
    BodyEnd end = BodyEnd::free;
    double length = 0.0;

    const LineSegment& at(double distance) const {
      const auto beyond = std::ranges::find_if(segments, [&](const auto& s) { return s.begin + s.length > distance; });
      return beyond == segments.end() ? segments.back() : *beyond;
    }
  };

  Line walk(Index cell, const Vector& from, const Vector& direction, double most) const {
    Line line{.segments = walk_line(mesh_, cell, from, direction, most)};
    for (std::size_t k = 0; k < line.segments.size(); ++k) {
      const LineSegment& in = line.segments[k];
      line.length = in.begin + in.length;
      if (in.exit < 0 || (mesh_.is_interior(in.exit) && !unknowns_.is_split(in.exit))) continue;
      line.face = in.exit;
      line.end = mesh_.is_interior(in.exit) ? BodyEnd::free : ends_[in.exit];
      line.segments.resize(k + 1);
    }
    return line;
  }

  std::vector<Vector> directions(const Vector& across) const {
    if (!unknowns_.plane_normal.isZero()) return {unknowns_.plane_normal.cross(across).normalized()};
    const Vector first = across.unitOrthogonal(), second = across.cross(first);
    std::vector<Vector> all;
    for (int k = 0; k < n_directions; ++k) {
      const double angle = std::numbers::pi * k / n_directions;
      all.emplace_back(std::cos(angle) * first + std::sin(angle) * second);
    }
    return all;
  }

  // Both ways from a point; twice as long with a plane of symmetry at one end.
  bool is_long(Index cell, const Vector& from, const Vector& along, double least) const {
    const Line ahead = walk(cell, from, along, least), back = walk(cell, from, -along, least);
    const bool is_half =
        (ahead.face >= 0 && ahead.end == BodyEnd::mirror) != (back.face >= 0 && back.end == BodyEnd::mirror);
    return (is_half ? 2.0 : 1.0) * (ahead.length + back.length) >= (1.0 - 1e-9) * least;
  }

  BendingLayers layers_of(SlenderCells of, const Line& through, const Vector& across, const Vector& along,
                          double times) const {
    BendingLayers found{.n = 0.0, .thickness = times * through.length, .length = 0.0, .stack = {}};
    std::vector<StackLayer> layers;
    for (const LineSegment& in : through.segments) {
      const auto [boxes_across, boxes_along] =
          mesh_.shape[in.cell] == CellShape::hexahedron ? std::array{1.0, 1.0} : boxes_of(of);
      const Index zone = unknowns_.zone[in.cell];
      layers.push_back({.cell = in.cell,
                        .zone = zone,
                        .thickness = in.length,
                        .modulus = plate_modulus(unknowns_.sound[zone]),
                        .count = in.length / (boxes_across * mean_chord(mesh_, in.cell, across))});
      found.n += times * layers.back().count;
      found.length += in.length / through.length * boxes_along * mean_chord(mesh_, in.cell, along);
    }
    found.stack = layer_stack(std::move(layers), times > 1.0);
    return found;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  FaceField<BodyEnd> ends_;
  double size_ = 0.0;  // of the mesh [m]
  bool is_mirrored_ = false;
};

bool may_be_slender(const Mesh& mesh, const Unknowns& unknowns) {
  return !unknowns.motion.any() && unknowns.periodic.empty() && !unknowns.is_axisymmetric() &&
         std::ranges::any_of(mesh.shape, [](CellShape shape) { return shape != CellShape::hexahedron; });
}

}  // namespace

SlenderCells slender_cells(const Mesh& mesh, Index cell, const Vector& across, const Vector& along) {
  if (mesh.shape[cell] == CellShape::polyhedron) return SlenderCells::polyhedra;
  if (mesh.shape[cell] != CellShape::wedge) return SlenderCells::tetrahedra;
  const Vector axis = axis_of(mesh, cell);
  const double by_across = std::abs(axis.dot(across)), by_along = std::abs(axis.dot(along));
  if (std::max(by_across, by_along) < 0.5) return SlenderCells::prisms_within;
  return by_across > by_along ? SlenderCells::prisms_across : SlenderCells::prisms_along;
}

std::array<double, 2> boxes_of(SlenderCells cells) {
  switch (cells) {
    case SlenderCells::prisms_across: return {1.0, 2.0};
    case SlenderCells::prisms_within: return {2.0, 2.0};
    case SlenderCells::prisms_along: return {2.0, 1.0};
    case SlenderCells::tetrahedra: return {3.0, 3.0};
    case SlenderCells::polyhedra: break;
  }
  return {1.0, 1.0};
}

double mean_chord(const Mesh& mesh, Index cell, const Vector& e) {
  double projected = 0.0;
  for (const Index f : mesh.faces_of_cell(cell)) projected += std::abs(mesh.face_area[f].dot(e));
  return 2.0 * mesh.cell_volume[cell] / projected;
}

// x is the excess of hexahedra as long, 1.5 (1 - nu) (length/even_thickness)^2; f tells how Poisson's effect across
// stiffens.
double SlenderLayers::error(double nu) const {
  const LayerStack& stack = layers.stack;
  const double f = poisson_share(nu), x = layers.excess_of_stack(nu), n = stack.even_layers();
  const double flat = layers.length / stack.even_thickness * n, rest = stack.layers - stack.lone;
  const double sees = 1.0 - 0.45 * stack.of_lone;  // of the excess, where materials are of one layer
  switch (of) {
    case SlenderCells::prisms_across:
      return 0.6 * flat / (flat + 1.6) * x / (1.0 + 0.1 * x) - (3.0 - 2.0 / n - 0.6 * f * (2.0 - 3.0 / n)) * rest -
             stack.lone;
    case SlenderCells::prisms_within:
      return sees * 1.3 * x / (1.0 + 0.3 * x) - (1.25 + 1.15 / n - 0.17 * f) * rest - 1.1 * stack.lone;
    case SlenderCells::prisms_along: return x / (1.0 + 0.23 * x) - (0.88 - 0.08 * f) * rest - 0.7 * stack.lone;
    case SlenderCells::tetrahedra:
      return sees * 0.63 * x / (1.0 + 0.13 * x) - (0.2 + 0.95 / n - 0.14 * f) * rest - 0.6 * stack.lone;
    case SlenderCells::polyhedra: break;
  }
  // By their number: those on the surfaces are halves.
  const double excess = layers.excess(nu), ratio = layers.length / layers.thickness * layers.n;
  return 3.3 * ratio * excess / (1.0 + excess) - 5.0 / (ratio * layers.n * layers.n);
}

double SlenderLayers::lack_of_cubics() const { return 0.5 * layers.stack.lone * layers.length / layers.thickness; }

std::vector<SlenderLayers> slender_layers(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<SlenderLayers> all;
  if (!may_be_slender(mesh, unknowns)) return all;
  const SlenderSearch search(mesh, unknowns);
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
    if (search.is_free(f))
      if (auto found = search.at(f)) all.push_back(std::move(*found));
  return all;
}

bool is_slender_body(const Mesh& mesh, const Unknowns& unknowns) {
  constexpr Index part = 10;
  if (!may_be_slender(mesh, unknowns)) return false;
  const SlenderSearch search(mesh, unknowns);
  Index n_free = 0, n_slender = 0;
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) {
    if (!search.is_free(f)) continue;
    ++n_free;
    if (search.at(f)) ++n_slender;
  }
  return n_slender > 0 && part * n_slender >= n_free;
}

// Cells between the lines, which these miss, follow two neighbours.
CellField<Vector> bending_prisms(const Mesh& mesh, const Unknowns& unknowns) {
  CellField<Vector> along(mesh.n_cells(), Vector::Zero());
  if (unknowns.plane_normal.isZero()) return along;
  const auto is_fit = [&](Index c) {
    return mesh.shape[c] == CellShape::wedge || mesh.shape[c] == CellShape::hexahedron;
  };
  bool any = false;
  for (const SlenderLayers& at : slender_layers(mesh, unknowns)) {
    const double nu = unknowns.sound[unknowns.zone[at.cell]].poisson_ratio();
    if (!at.layers.is_wrong(nu)) continue;
    for (const Index c : at.through)
      if (is_fit(c)) along[c] = at.along;
    any = true;
  }
  for (int pass = 0; any && pass < 2; ++pass) {
    const CellField<Vector> before = along;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      if (!is_fit(c) || !before[c].isZero()) continue;
      std::vector<Vector> beside;
      for (const Index f : mesh.faces_of_cell(c))
        if (mesh.is_interior(f) && !unknowns.is_split(f) && !before[mesh.across(f, c)].isZero())
          beside.push_back(before[mesh.across(f, c)]);
      if (beside.size() >= 2) along[c] = beside.front();
    }
  }
  return along;
}

}  // namespace pfdm
