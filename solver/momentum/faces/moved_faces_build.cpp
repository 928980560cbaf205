// Which points the faces of nearly incompressible cells have, and from what they take their displacements.

#include "mesh/geometry.h"
#include "solver/momentum/faces/moved_faces.h"
#include "solver/momentum/faces/surface_slopes.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace pfdm {
namespace {

// The points of the cells with a pressure, each as often as there are cells: those that belong together, across links
// and interfaces that hold, are one corner.
class PointsOfCells {
 public:
  PointsOfCells(const Mesh& mesh, const Unknowns& unknowns) : offsets_(mesh.n_cells() + 1, 0) {
    std::vector<char> has(mesh.n_cells(), 0);
    for (const Index c : unknowns.pressure_cells) has[c] = 1;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      if (has[c] != 0) add(mesh, c);
      offsets_[c + 1] = points_.size();
    }
    together_.resize(points_.size());
    std::iota(together_.begin(), together_.end(), std::size_t{0});
  }

  bool has(Index cell) const { return offsets_[cell + 1] > offsets_[cell]; }
  std::size_t begin(Index cell) const { return offsets_[cell]; }
  std::size_t end(Index cell) const { return offsets_[cell + 1]; }
  Index point(std::size_t slot) const { return points_[slot]; }

  void unite(Index P, Index N, Index point) {
    const std::size_t a = root(slot(P, point)), b = root(slot(N, point));
    together_[std::max(a, b)] = std::min(a, b);
  }
  std::size_t root(std::size_t slot) {
    while (together_[slot] != slot) slot = together_[slot] = together_[together_[slot]];
    return slot;
  }
  std::size_t slot(Index cell, Index point) const {
    const auto first = points_.begin() + begin(cell);
    const auto last = points_.begin() + end(cell);
    return static_cast<std::size_t>(std::lower_bound(first, last, point) - points_.begin());
  }

 private:
  void add(const Mesh& mesh, Index cell) {
    const auto first = static_cast<std::ptrdiff_t>(points_.size());
    for (const Index f : mesh.faces_of_cell(cell)) {
      for (const Index p : mesh.points_of_face(f)) points_.push_back(p);
      if (mesh.face_apex.size() > 0) points_.push_back(mesh.face_apex[f]);
    }
    std::sort(points_.begin() + first, points_.end());
    points_.erase(std::unique(points_.begin() + first, points_.end()), points_.end());
  }

  std::vector<std::size_t> offsets_, together_;
  std::vector<Index> points_;
};

std::vector<Index> points_and_apex(const Mesh& mesh, Index face) {
  const auto ids = mesh.points_of_face(face);
  std::vector<Index> all(ids.begin(), ids.end());
  if (mesh.face_apex.size() > 0 && std::ranges::find(all, mesh.face_apex[face]) == all.end())
    all.push_back(mesh.face_apex[face]);
  return all;
}

}  // namespace

class MovedFaces::Builder {
 public:
  Builder(const Mesh& mesh, const Unknowns& unknowns, const std::vector<MovedFaces::Place>& places,
          const BondedSides& bonded, MovedFaces& faces)
      : mesh_(mesh), unknowns_(unknowns), places_(places), bonded_(bonded), faces_(faces), points_(mesh, unknowns) {}

  void build() {
    number_corners();
    gather_from_cells();
    gather_from_nodes();
    for (std::size_t k = 0; k < faces_.corners_.size(); ++k) store_samples(k);
    for (const MovedFaces::Place& place : places_)
      faces_.loops_.push_back(points_.has(place.cell) ? loop(place.face, place.cell) : MovedFaces::Loop{});
    if (unknowns_.is_axisymmetric()) add_sections(), turn_corners();
  }

 private:
  // Sample of a corner on faces with nodes, with the directions in which the node is held.
  struct OnNode {
    MovedFaces::Sample sample;
    Tensor held;
    bool glides;
    std::vector<SurfaceSlopes::Sample> around{};  // of one that glides along a face whose displacement may vary
  };

  void unite(Index P, Index N, Index face) {
    if (!points_.has(P) || !points_.has(N)) return;
    for (const Index p : points_and_apex(mesh_, face)) points_.unite(P, N, p);
  }

  // Held across itself alone: where it is held along itself, too, its displacement may vary along it.
  bool is_on_roller(const MovedFaces::Place& place) const {
    const Tensor& free = unknowns_.free_directions[place.node - unknowns_.n_cells];
    const Vector n = mesh_.face_area[place.face].normalized(), &across = unknowns_.plane_normal;
    const double n_held = 3.0 - free.trace() - (across.isZero() ? 0.0 : 1.0 - across.dot(free * across));
    return unknowns_.glides(place.node, n) && n_held < 1.5;
  }

  // Both sides of an interface that holds have one node.
  void unite_across_nodes() {
    std::vector<Index> cell_at(unknowns_.n_nodes() - unknowns_.n_cells, -1);
    for (const MovedFaces::Place& place : places_) {
      if (place.node < 0) continue;
      Index& first = cell_at[place.node - unknowns_.n_cells];
      if (first >= 0) unite(first, place.cell, place.face);
      first = place.cell;
    }
  }

  void number_corners() {
    for (const MovedFaces::Place& place : places_)
      if (place.beyond >= 0) unite(place.cell, place.beyond, place.face);
    unite_across_nodes();
    for (Index c = 0; c < mesh_.n_cells(); ++c)
      for (std::size_t s = points_.begin(c); s < points_.end(c); ++s) {
        const std::size_t root = points_.root(s);
        if (root == s) {
          corner_of_slot_.push_back(count_of(faces_.corners_));
          faces_.corners_.push_back({.point = mesh_.points[points_.point(s)]});
        } else {
          corner_of_slot_.push_back(corner_of_slot_[root]);
        }
      }
    from_cells_.resize(faces_.corners_.size());
    from_nodes_.resize(faces_.corners_.size());
  }

  Index corner(Index cell, Index point) const { return corner_of_slot_[points_.slot(cell, point)]; }

  Vector within(Vector d) const {
    if (unknowns_.is_axisymmetric()) d -= unknowns_.plane_normal.dot(d) * unknowns_.plane_normal;
    return d;
  }

  void gather_from_cells() {
    for (Index c = 0; c < mesh_.n_cells(); ++c)
      for (std::size_t s = points_.begin(c); s < points_.end(c); ++s)
        from_cells_[corner_of_slot_[s]].push_back(
            {.node = c, .cell = c, .bonded = -1, .d = within(mesh_.points[points_.point(s)] - mesh_.cell_centre[c])});
  }

  Tensor held_directions(Index node) const {
    return Tensor::Identity() - unknowns_.free_directions[node - unknowns_.n_cells];
  }
  static bool are_alike(const Tensor& held, const Tensor& other) {
    constexpr double rounding = 1e-9;
    return (held - other).norm() < rounding;
  }

  void gather_from_nodes() {
    std::optional<SurfaceSlopes> slopes;
    const PatchCondition* on = nullptr;
    for (const MovedFaces::Place& place : places_) {
      if (place.node < 0 || !points_.has(place.cell)) continue;
      const Tensor held = held_directions(place.node);
      const bool glides = is_on_roller(place);
      std::vector<SurfaceSlopes::Sample> around;
      if (const PatchCondition* here = glides ? varied_on(place.face) : nullptr; here != nullptr) {
        if (here != on) slopes.emplace(mesh_, mesh_.patches[here->patch]);
        on = here;
        around = slopes->at(place.face, [&](Index face) {
          const Index node = unknowns_.node_of_face[face];
          return node >= 0 && are_alike(held_directions(node), held);
        });
      }
      for (const Index p : points_and_apex(mesh_, place.face))
        from_nodes_[corner(place.cell, p)].push_back(
            {.sample = {.node = place.node,
                        .cell = place.cell,
                        .bonded = bonded_.number(place.side),
                        .d = within(mesh_.points[p] - mesh_.face_centre[place.face])},
             .held = held,
             .glides = glides,
             .around = around});
    }
  }

  // Condition on the surface of a face whose prescribed displacement is a function of the place; null if there is none.
  const PatchCondition* varied_on(Index face) const {
    for (const PatchCondition& on : unknowns_.conditions) {
      const Patch& patch = mesh_.patches[on.patch];
      const bool is_there = face >= patch.first_face && face < patch.first_face + patch.n_faces;
      if (is_there && on.condition.kind == BoundaryCondition::Kind::components && on.condition.value) return &on;
    }
    return nullptr;
  }

  // Stores the samples so that those held in the same directions stand together.
  void store_samples(std::size_t k) {
    MovedFaces::Corner& corner = faces_.corners_[k];
    corner.begin = faces_.samples_.size();
    corner.first_hold = faces_.holds_.size();
    std::vector<OnNode>& rest = from_nodes_[k];
    if (rest.empty()) faces_.samples_.insert(faces_.samples_.end(), from_cells_[k].begin(), from_cells_[k].end());
    while (!rest.empty()) {
      const Tensor held = rest.front().held;
      const auto end =
          std::stable_partition(rest.begin(), rest.end(), [&](const OnNode& on) { return are_alike(on.held, held); });
      const bool glides = std::all_of(rest.begin(), end, [](const OnNode& on) { return on.glides; });
      MovedFaces::Hold hold{.directions = held,
                            .begin = faces_.samples_.size(),
                            .end = 0,
                            .glides = glides,
                            .first_rise = faces_.rises_.size()};
      const auto is_bonded = [](const OnNode& on) { return on.sample.bonded >= 0; };
      const bool any_bonded = std::any_of(rest.begin(), end, is_bonded);  // their gradients are those of the surface
      for (auto on = rest.begin(); on != end; ++on) {
        if (any_bonded && !is_bonded(*on)) continue;
        for (const SurfaceSlopes::Sample& of : on->around)
          faces_.rises_.push_back({.sample = faces_.samples_.size(),
                                   .node = unknowns_.node_of_face[of.face],
                                   .part = of.coefficient.dot(on->sample.d)});
        faces_.samples_.push_back(on->sample);
      }
      hold.end = faces_.samples_.size(), hold.end_rise = faces_.rises_.size();
      if (!held.isZero()) faces_.holds_.push_back(hold);
      rest.erase(rest.begin(), end);
    }
    corner.end = faces_.samples_.size();
    corner.end_of_holds = faces_.holds_.size();
  }

  MovedFaces::Loop loop(Index face, Index cell) {
    MovedFaces::Loop loop{
        .begin = faces_.loop_corners_.size(), .size = mesh_.face_area[face].norm(), .centre = mesh_.face_centre[face]};
    const auto ids = mesh_.points_of_face(face);
    std::vector<Index> points(ids.begin(), ids.end());
    if (mesh_.owner[face] != cell) std::ranges::reverse(points);
    const Vector normal = mesh_.outward_area(face, cell) / loop.size;
    const Vector apex = fan_middle(mesh_, face);
    for (std::size_t i = 0; i < points.size(); ++i) {
      faces_.loop_corners_.push_back(corner(cell, points[i]));
      const Vector &a = mesh_.points[points[i]], &b = mesh_.points[points[(i + 1) % points.size()]];
      faces_.shares_.push_back(0.5 * (a - apex).cross(b - apex).dot(normal) / loop.size);
    }
    if (mesh_.face_apex.size() > 0) loop.apex = corner(cell, mesh_.face_apex[face]);
    loop.end = faces_.loop_corners_.size();
    return loop;
  }

  void add_sections() {
    faces_.section_of_cell_.assign(mesh_.n_cells(), -1);
    for (const PatchCondition& on : unknowns_.conditions) {
      if (on.condition.kind != BoundaryCondition::Kind::axisymmetric) continue;
      const Patch& patch = mesh_.patches[on.patch];
      for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
        const Index c = mesh_.owner[f];
        Index& section = faces_.section_of_cell_[c];
        if (section >= 0 || !points_.has(c)) continue;
        section = count_of(faces_.sections_);
        faces_.sections_.push_back(loop(f, c));
      }
    }
  }

  void turn_corners() {
    for (const MovedFaces::Corner& corner : faces_.corners_) {
      Tensor turn = Vector::UnitZ() * Vector::UnitZ().transpose();
      const double r = unknowns_.radial.dot(corner.point);
      constexpr double on_axis = 1e-9;
      if (r > on_axis * corner.point.norm())
        turn += Vector(corner.point.x(), corner.point.y(), 0.0) / r * unknowns_.radial.transpose();
      faces_.turns_.push_back(turn);
    }
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  const std::vector<MovedFaces::Place>& places_;
  const BondedSides& bonded_;
  MovedFaces& faces_;
  PointsOfCells points_;
  std::vector<Index> corner_of_slot_;
  std::vector<std::vector<MovedFaces::Sample>> from_cells_;
  std::vector<std::vector<OnNode>> from_nodes_;
};

MovedFaces::MovedFaces(const Mesh& mesh, const Unknowns& unknowns, const std::vector<Place>& places,
                       const BondedSides& bonded) {
  if (!unknowns.pressure_cells.empty()) Builder(mesh, unknowns, places, bonded, *this).build();
}

}  // namespace pfdm
