#include "mesh/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "physics/error.h"

namespace pfdm {
namespace {

constexpr double collinear_sine = 1e-6;

std::string place(const Vector& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z()); }

class BoundaryEdges {
 public:
  explicit BoundaryEdges(const Mesh& mesh) : mesh_(mesh) {
    for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) {
      const auto rim = mesh.points_of_face(f);
      for (std::size_t i = 0; i < rim.size(); ++i) {
        const Index a = rim[i], b = rim[(i + 1) % rim.size()];
        ends_[a].insert(b);
        ends_[b].insert(a);
      }
    }
  }

  // A point within the edge from a to b, if edges lead over it from a to b.
  std::optional<Index> hanging_point(Index a, Index b) const {
    std::optional<Index> first;
    for (Index at = a;;) {
      const std::optional<Index> next = next_towards(at, b, at == a);
      if (!next) return std::nullopt;
      if (*next == b) return first;
      if (!first) first = next;
      at = *next;
    }
  }

  const std::map<Index, std::set<Index>>& ends() const { return ends_; }

 private:
  // The end of the shortest edge from `from` that lies along the way to b; the whole way only if it is not the edge.
  std::optional<Index> next_towards(Index from, Index b, bool is_edge) const {
    const Vector way = point(b) - point(from);
    std::optional<Index> nearest;
    double length = is_edge ? (1.0 - collinear_sine) * way.norm() : (1.0 + collinear_sine) * way.norm();
    for (const Index end : ends_.at(from)) {
      const Vector step = point(end) - point(from);
      if (step.norm() >= length || step.dot(way) <= 0.0) continue;
      if (step.cross(way).norm() > collinear_sine * step.norm() * way.norm()) continue;
      nearest = end;
      length = step.norm();
    }
    return nearest;
  }

  const Vector& point(Index p) const { return mesh_.points[p]; }

  const Mesh& mesh_;
  std::map<Index, std::set<Index>> ends_;
};

void require_no_hanging_points(const Mesh& mesh) {
  const BoundaryEdges edges(mesh);
  for (const auto& [a, ends] : edges.ends())
    for (const Index b : ends)
      if (a < b)
        if (const auto p = edges.hanging_point(a, b))
          throw InputError(fmt::format(
              "cells do not match: the point at {} is a hanging node on the edge from {} to {} of another cell; "
              "refined and coarse cells must be joined by cells that share their faces",
              place(mesh.points[*p]), place(mesh.points[a]), place(mesh.points[b])));
}

void require_no_split_quadrilaterals(const Mesh& mesh) {
  using Triangle = std::array<Index, 3>;
  std::set<Triangle> triangles;
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) {
    const auto p = mesh.points_of_face(f);
    if (p.size() != 3) continue;
    Triangle key{p[0], p[1], p[2]};
    std::ranges::sort(key);
    triangles.insert(key);
  }
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces() && !triangles.empty(); ++f) {
    const auto p = mesh.points_of_face(f);
    for (std::size_t i = 0; i < 4 && p.size() == 4; ++i) {
      Triangle key{p[i], p[(i + 1) % 4], p[(i + 2) % 4]};
      std::ranges::sort(key);
      if (triangles.contains(key))
        throw InputError(
            fmt::format("cells do not match: a triangle lies on the quadrilateral at {}; hexahedra or prisms must be "
                        "joined to tetrahedra by pyramids",
                        place(mesh.face_centre[f])));
    }
  }
}

}  // namespace

void require_matching_cells(const Mesh& mesh) {
  require_no_hanging_points(mesh);
  require_no_split_quadrilaterals(mesh);
}

}  // namespace pfdm
