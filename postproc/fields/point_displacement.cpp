#include "postproc/fields/point_displacement.h"

#include "mesh/disjoint_sets.h"
#include "physics/error.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>

namespace pfdm {
namespace {

constexpr double parallel_sine = 1e-3;  // of the angle below which two normals are one
// Above it the gradient of a cell may be that of an opening, which leads far beyond its faces.
constexpr double stretched_damage = 0.5;

// The cells around every point, in ascending order; those of a face's apex are the cells of the face.
class CellsOfPoints {
 public:
  explicit CellsOfPoints(const Mesh& mesh) : offsets_(mesh.points.size() + 1, 0) {
    const auto for_each = [&](const auto& visit) {
      for (Index c = 0; c < mesh.n_cells(); ++c) {
        for (const Index p : mesh.points_of_cell(c)) visit(p, c);
        if (mesh.face_apex.size() == 0) continue;
        for (const Index f : mesh.faces_of_cell(c)) visit(mesh.face_apex[f], c);
      }
    };
    for_each([&](Index p, Index) { ++offsets_[p + 1]; });
    for (std::size_t p = 1; p < offsets_.size(); ++p) offsets_[p] += offsets_[p - 1];
    std::vector<std::size_t> end(offsets_.begin(), offsets_.end() - 1);
    cells_.resize(offsets_.back());
    for_each([&](Index p, Index c) {
      std::size_t& at = end[p];
      if (at == offsets_[p] || cells_[at - 1] != c) cells_[at++] = c;  // once, though an apex of many faces
    });
    ends_ = std::move(end);
  }

  std::span<const Index> operator[](Index point) const {
    const std::size_t begin = offsets_[point];
    return {cells_.data() + begin, ends_[point] - begin};
  }

 private:
  std::vector<std::size_t> offsets_, ends_;
  std::vector<Index> cells_;
};

bool has_point(const Mesh& mesh, Index face, Index point) {
  if (mesh.face_apex.size() > 0 && mesh.face_apex[face] == point) return true;
  return std::ranges::find(mesh.points_of_face(face), point) != mesh.points_of_face(face).end();
}

// Some displacements are prescribed: q_i.u = v_i for orthonormal q_i.
class Held {
 public:
  /// n.u = value for a unit normal; nothing where the others say it already.
  void along(const Vector& n, double value) {
    Vector rest = n;
    for (std::size_t i = 0; i < n_; ++i) {
      rest -= direction_[i].dot(n) * direction_[i];
      value -= direction_[i].dot(n) * value_[i];
    }
    const double sine = rest.norm();
    if (n_ == direction_.size() || sine < parallel_sine) return;
    direction_[n_] = rest / sine;
    value_[n_++] = value / sine;
  }

  Vector operator()(Vector u) const {
    for (std::size_t i = 0; i < n_; ++i) u += (value_[i] - direction_[i].dot(u)) * direction_[i];
    return u;
  }

 private:
  std::array<Vector, 3> direction_;
  std::array<double, 3> value_{};
  std::size_t n_ = 0;
};

// None where a formula has no value at a point, though it has one at the middle of each face around.
std::optional<Vector> prescribed_value(const BoundaryCondition& condition, const Vector& x, double load) {
  if (!condition.value) return Vector::Zero();
  try {
    return condition.value(x, load);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void hold_point(const BoundaryCondition& condition, const Vector& x, const Vector& normal, double load, Held& held) {
  using Kind = BoundaryCondition::Kind;
  if (condition.kind == Kind::symmetry || condition.kind == Kind::axisymmetric) held.along(normal, 0.0);
  if (condition.kind != Kind::components || std::ranges::count(condition.displacement_prescribed, true) == 0) return;
  const auto value = prescribed_value(condition, x, load);
  for (Index i = 0; value && i < 3; ++i)
    if (condition.displacement_prescribed[i]) held.along(Vector::Unit(i), (*value)[i]);
}

std::map<Index, Held> held_points(const Mesh& mesh, const std::vector<BoundaryCondition>& boundary, double load) {
  std::map<Index, Held> held;
  std::vector<bool> seen(mesh.points.size());
  for (const BoundaryCondition& condition : boundary) {
    const Patch& patch = mesh.patch(condition.patch);
    seen.assign(seen.size(), false);
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const auto hold = [&](Index p) {
        if (!seen[p]) hold_point(condition, mesh.points[p], mesh.face_area[f].normalized(), load, held[p]);
        seen[p] = true;
      };
      for (const Index p : mesh.points_of_face(f)) hold(p);
      if (mesh.face_apex.size() > 0) hold(mesh.face_apex[f]);
    }
  }
  return held;
}

class PointMover {
 public:
  PointMover(const Mesh& mesh, const OutputFields& output)
      : mesh_(mesh), output_(output), cells_(mesh), is_cohesive_(mesh.n_faces()), at_cohesive_(mesh.points.size()) {
    for (const OutputInterface& interface : output.interfaces)
      for (const Index f : interface.faces) {
        is_cohesive_[f] = true;
        for (const Index p : mesh.points_of_face(f)) at_cohesive_[p] = true;
        if (mesh.face_apex.size() > 0) at_cohesive_[mesh.face_apex[f]] = true;
      }
  }

  SplitPoints move() const {
    const auto n_points = count_of(mesh_.points);
    SplitPoints split;
    split.displacement.assign(n_points, Vector::Zero());
    std::vector<char> may_part(n_points, 0);
    parallel_for(n_points, [&](Index p) {
      const std::span<const Index> around = cells_[p];
      may_part[p] = at_cohesive_[p] || std::ranges::any_of(around, [&](Index c) { return is_broken(c); });
      if (!may_part[p]) split.displacement[p] = mean(p, around);
    });
    for (Index p = 0; p < n_points; ++p)
      if (may_part[p]) part(p, split);
    return split;
  }

 private:
  using Cells = std::vector<Index>;

  bool is_broken(Index cell) const { return !(output_.damage[cell] <= broken_damage); }

  Vector mean(Index point, std::span<const Index> cells) const {
    Vector sum = Vector::Zero(), low = Vector::Constant(std::numeric_limits<double>::infinity()), high = -low;
    double weights = 0.0, most_damage = 0.0;
    for (const Index c : cells) {
      const Vector from_centre = mesh_.points[point] - mesh_.cell_centre[c];
      const double sound = 1.0 - output_.damage[c];
      const double weight = (sound * sound + 1e-6) / from_centre.norm();
      sum += weight * (output_.displacement[c] + output_.gradient[c] * from_centre);
      weights += weight;
      most_damage = std::max(most_damage, output_.damage[c]);
      low = low.cwiseMin(output_.displacement[c]);
      high = high.cwiseMax(output_.displacement[c]);
    }
    if (cells.empty()) return sum;
    return most_damage > stretched_damage ? (sum / weights).cwiseMax(low).cwiseMin(high).eval()
                                          : (sum / weights).eval();
  }

  // The sides of the crack at a point, first its sound cells, in the order of their first cells.
  std::vector<Cells> sound_sides(Index point) const {
    const std::span<const Index> around = cells_[point];
    DisjointSets sets(around.size());
    for_each_neighbour(point, [&](std::size_t i, std::size_t j) {
      if (!is_broken(around[i]) && !is_broken(around[j])) sets.join(i, j);
    });
    std::map<std::size_t, Cells> sides;
    for (std::size_t i = 0; i < around.size(); ++i)
      if (!is_broken(around[i])) sides[sets.least_with(i)].push_back(around[i]);
    std::vector<Cells> list;
    list.reserve(sides.size());
    for (auto& [first, cells] : sides) list.push_back(std::move(cells));
    return list;
  }

  // visit(i, j) for the cells i and j around the point that have a face at it between them, once each way; not where
  // that is cohesive.
  template <class Visit>
  void for_each_neighbour(Index point, const Visit& visit) const {
    const std::span<const Index> around = cells_[point];
    for (std::size_t i = 0; i < around.size(); ++i)
      for (const Index f : mesh_.faces_of_cell(around[i])) {
        if (!mesh_.is_interior(f) || is_cohesive_[f] || !has_point(mesh_, f, point)) continue;
        const auto j = std::ranges::lower_bound(around, mesh_.across(f, around[i])) - around.begin();
        visit(i, static_cast<std::size_t>(j));
      }
  }

  // The side of each cell around the point; broken ones go with a neighbour, from the sound ones on.
  std::vector<std::size_t> side_of_cells(Index point, const std::vector<Cells>& sides) const {
    const std::span<const Index> around = cells_[point];
    constexpr auto none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> side(around.size(), none);
    for (std::size_t s = 0; s < sides.size(); ++s)
      for (const Index c : sides[s]) side[std::ranges::lower_bound(around, c) - around.begin()] = s;
    for (bool grows = true; grows;) {
      grows = false;
      const std::vector<std::size_t> before = side;
      for_each_neighbour(point, [&](std::size_t i, std::size_t j) {
        if (before[i] != none || before[j] == none || side[i] <= before[j]) return;
        side[i] = before[j];
        grows = true;
      });
    }
    std::ranges::replace(side, none, std::size_t{0});
    return side;
  }

  // The first side keeps the point.
  void part(Index point, SplitPoints& split) const {
    const std::vector<Cells> sides = sound_sides(point);
    Vector& here = split.displacement[point];
    here = sides.empty() ? mean(point, cells_[point]) : mean(point, sides[0]);
    if (sides.size() < 2) return;
    const std::vector<std::size_t> side = side_of_cells(point, sides);
    for (std::size_t s = 1; s < sides.size(); ++s) {
      PointCopy copy{.point = point, .cells = {}};
      for (std::size_t i = 0; i < side.size(); ++i)
        if (side[i] == s) copy.cells.push_back(cells_[point][i]);
      split.copies.push_back(std::move(copy));
      split.displacement.push_back(mean(point, sides[s]));
    }
  }

  const Mesh& mesh_;
  const OutputFields& output_;
  CellsOfPoints cells_;
  std::vector<bool> is_cohesive_, at_cohesive_;  // faces; points on them
};

}  // namespace

SplitPoints point_displacement(const Mesh& mesh, const std::vector<BoundaryCondition>& boundary,
                               const OutputFields& output, double load) {
  SplitPoints split = PointMover(mesh, output).move();
  const std::map<Index, Held> held = held_points(mesh, boundary, load);
  for (const auto& [point, hold] : held) split.displacement[point] = hold(split.displacement[point]);
  for (std::size_t k = 0; k < split.copies.size(); ++k)
    if (const auto found = held.find(split.copies[k].point); found != held.end())
      split.displacement[mesh.points.size() + k] = found->second(split.displacement[mesh.points.size() + k]);
  return split;
}

}  // namespace pfdm
