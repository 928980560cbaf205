#include "solver/momentum/bending/confined_layers.h"

#include "mesh/bounding_box.h"
#include "mesh/search/line_walk.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/body_ends.h"
#include "solver/momentum/bending/slender_layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace pfdm {
namespace {

constexpr double much_stiffer = 10.0;  // Young's modulus of one material over that of another
constexpr double least_width = 2.0;    // over the thickness
constexpr double inside = 0.43;        // of the thickness: a height at which lines along the layer follow no faces
constexpr Index most_faces = 2000;
constexpr int directions_in_half_turn = 8;

enum class InLayerEnd : char { free, mirror, held, other };

// Through the cells of one zone.
struct InLayer {
  std::vector<LineSegment> segments;
  Index face = -1;  // at its end
  InLayerEnd end = InLayerEnd::other;
  double length = 0.0;
};

class ConfinedSearch {
 public:
  ConfinedSearch(const Mesh& mesh, const Unknowns& unknowns)
      : mesh_(mesh), unknowns_(unknowns), ends_(body_ends(mesh, unknowns)), has_pressure_(mesh.n_cells(), 0) {
    const Box box = bounding_box(mesh.points);
    size_ = (box.high - box.low).norm();
    for (const Index c : unknowns.pressure_cells) has_pressure_[c] = 1;
  }

  bool is_held(Index face, Index cell) const {
    return has_pressure_[cell] == 0 && end_at(cell, face) == InLayerEnd::held;
  }

  std::optional<ConfinedLayer> at(Index face, Index cell) const {
    const Vector across = -mesh_.outward_area(face, cell).normalized();
    const InLayer through = walk(cell, mesh_.face_centre[face], across);
    if (through.end != InLayerEnd::held && through.end != InLayerEnd::mirror) return std::nullopt;
    if (std::abs(mesh_.face_area[through.face].normalized().dot(across)) < 0.95) return std::nullopt;
    const double times = through.end == InLayerEnd::mirror ? 2.0 : 1.0;
    ConfinedLayer found{.cell = cell, .area = mesh_.face_area[face].norm(), .thickness = times * through.length};
    const Vector along = add_spans(through, mesh_.face_centre[face] + inside * through.length * across, across, found);
    if (found.n_spans == 0) return std::nullopt;
    for (const LineSegment& in : through.segments) {
      const SlenderCells of = cells_in(in.cell, across, along);
      if (of == SlenderCells::polyhedra) return std::nullopt;
      found.of_tetrahedra = found.of_tetrahedra || of == SlenderCells::tetrahedra;
      found.layers += times * in.length / (boxes_of(of)[0] * mean_chord(mesh_, in.cell, across));
    }
    return found;
  }

 private:
  SlenderCells cells_in(Index cell, const Vector& across, const Vector& along) const {
    return mesh_.shape[cell] == CellShape::hexahedron ? SlenderCells::prisms_across
                                                      : slender_cells(mesh_, cell, across, along);
  }

  InLayerEnd end_at(Index cell, Index face) const {
    if (!mesh_.is_interior(face)) {
      if (ends_[face] == BodyEnd::held) return InLayerEnd::held;
      return ends_[face] == BodyEnd::mirror ? InLayerEnd::mirror : InLayerEnd::free;
    }
    if (unknowns_.is_split(face)) return InLayerEnd::free;
    const auto modulus = [&](Index c) { return unknowns_.sound[unknowns_.zone[c]].young_modulus(); };
    const double ratio = modulus(mesh_.across(face, cell)) / modulus(cell);
    if (ratio >= much_stiffer) return InLayerEnd::held;
    return ratio <= 1.0 / much_stiffer ? InLayerEnd::free : InLayerEnd::other;
  }

  // The axis of an axisymmetric mesh is an end as a plane of symmetry is.
  InLayer walk(Index cell, const Vector& from, const Vector& direction) const {
    InLayer line{.segments = walk_line(mesh_, cell, from, direction, 2.0 * size_)};
    for (std::size_t k = 0; k < line.segments.size(); ++k) {
      const LineSegment& in = line.segments[k];
      line.length = in.begin + in.length;
      line.face = in.exit;
      if (in.exit < 0) continue;
      if (mesh_.is_interior(in.exit) && !unknowns_.is_split(in.exit) &&
          unknowns_.zone[mesh_.across(in.exit, in.cell)] == unknowns_.zone[in.cell])
        continue;
      line.end = is_on_axis(from + line.length * direction) ? InLayerEnd::mirror : end_at(in.cell, in.exit);
      line.segments.resize(k + 1);
    }
    return line;
  }
  bool is_on_axis(const Vector& place) const {
    return unknowns_.is_axisymmetric() && std::abs(place.dot(unknowns_.radial)) < 1e-6 * size_;
  }

  // Between free edges, or one and a plane of symmetry; no width elsewhere.
  ConfinedLayer::Span span(Index cell, const Vector& from, const Vector& across, const Vector& along) const {
    ConfinedLayer::Span found;
    int n_free = 0, n_mirrors = 0;
    for (const double way : {1.0, -1.0}) {
      const InLayer line = walk(cell, from, way * along);
      n_free += line.end == InLayerEnd::free ? 1 : 0;
      n_mirrors += line.end == InLayerEnd::mirror ? 1 : 0;
      found.width += line.length;
      if (line.end != InLayerEnd::free) continue;
      const Index last = line.segments.back().cell;
      const double boxes = cells_in(last, across, along) == SlenderCells::prisms_within ? 2.0 : 1.0;
      found.cells = std::max(found.cells, boxes * mean_chord(mesh_, last, along));
    }
    if (n_free == 0 || n_free + n_mirrors < 2) return {};
    if (n_mirrors > 0) found.width *= 2.0;
    return found;
  }

  // Returns the direction of the shorter one.
  Vector add_spans(const InLayer& through, const Vector& within, const Vector& across, ConfinedLayer& found) const {
    const auto beyond = std::ranges::find_if(
        through.segments, [&](const LineSegment& s) { return s.begin + s.length > inside * through.length; });
    const Index cell = beyond == through.segments.end() ? through.segments.back().cell : beyond->cell;
    const auto add = [&](const Vector& along) {
      const ConfinedLayer::Span at = span(cell, within, across, along);
      if (at.width > least_width * found.thickness) found.spans[static_cast<std::size_t>(found.n_spans++)] = at;
    };
    if (!unknowns_.plane_normal.isZero()) {
      Vector along = unknowns_.plane_normal.cross(across).normalized();
      add(along);
      if (found.n_spans == 1 && reaches_axis(cell, within)) found.spans[1] = found.spans[0], found.n_spans = 2;
      return along;
    }
    const Vector first = across.unitOrthogonal(), second = across.cross(first);
    Vector shortest = first;
    double width = 0.0;
    for (int k = 0; k < directions_in_half_turn; ++k) {
      const double angle = std::numbers::pi * k / directions_in_half_turn;
      const Vector along = std::cos(angle) * first + std::sin(angle) * second;
      const double at = span(cell, within, across, along).width;
      if (at > 0.0 && (width == 0.0 || at < width)) shortest = along, width = at;
    }
    add(shortest);
    add(across.cross(shortest));
    return shortest;
  }
  bool reaches_axis(Index cell, const Vector& from) const {
    return unknowns_.is_axisymmetric() && walk(cell, from, Vector(-unknowns_.radial)).end == InLayerEnd::mirror;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  FaceField<BodyEnd> ends_;
  CellField<char> has_pressure_;
  double size_ = 0.0;  // of the mesh [m]
};

}  // namespace

double ConfinedLayer::error(const IsotropicElasticity& of, double refined) const {
  if (n_spans == 0) return 0.0;
  const double M = of.constrained_modulus(), E = of.young_modulus(), nu = of.poisson_ratio();
  const double length = thickness * std::sqrt(M / (12.0 * of.mu)), free = n_spans == 1 ? E / (1.0 - nu * nu) : E;
  double constrained = 1.0, lost = 0.0;
  for (int k = 0; k < n_spans; ++k) {
    const Span& at = spans[static_cast<std::size_t>(k)];
    const double w = 0.5 * at.width / length, g = 1.0 - std::tanh(w) / w;
    const double slope = 0.5 * (std::tanh(w) / w - 1.0 / (std::cosh(w) * std::cosh(w)));
    const double c = at.cells / (thickness * refined) + 1.5 / (layers * layers * refined * refined + 1.0);
    lost = lost * g + constrained * c * slope;
    constrained *= g;
  }
  const double part = (n_spans == 1 ? 1.0 : 0.85) * (of_tetrahedra ? 0.75 : 1.0);
  return -part * lost * (M - free) / (free + (M - free) * constrained) * thickness / length;
}

std::vector<ConfinedLayer> confined_layers(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<ConfinedLayer> all;
  if (unknowns.motion.any() || !unknowns.periodic.empty() || unknowns.plane_stress) return all;
  const ConfinedSearch search(mesh, unknowns);
  std::vector<std::array<Index, 2>> held;  // face, cell
  for (Index f = 0; f < mesh.n_faces(); ++f) {
    if (search.is_held(f, mesh.owner[f])) held.push_back({f, mesh.owner[f]});
    if (mesh.is_interior(f) && search.is_held(f, mesh.neighbour[f])) held.push_back({f, mesh.neighbour[f]});
  }
  const std::size_t step = 1 + held.size() / most_faces;
  for (std::size_t k = 0; k < held.size(); k += step) {
    const ConfinedLayer none{.cell = held[k][1], .area = mesh.face_area[held[k][0]].norm()};
    all.push_back(search.at(held[k][0], held[k][1]).value_or(none));
  }
  return all;
}

}  // namespace pfdm
