#include "mesh/search/flat_surface.h"

#include "physics/error.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

constexpr double rounding = 1e-6;  // of lengths

// By how far a point is above the plane [m].
double height(const FlatSurface& surface, const Vector& x) { return surface.normal.dot(x - surface.point); }

bool has_boundary_face_in(const Mesh& mesh, const FlatSurface& surface, Index cell, double tolerance) {
  return std::ranges::any_of(mesh.faces_of_cell(cell), [&](Index f) {
    return !mesh.is_interior(f) && std::ranges::all_of(mesh.points_of_face(f), [&](Index p) {
      return std::abs(height(surface, mesh.points[p])) <= tolerance;
    });
  });
}

bool goes_through(const Mesh& mesh, const FlatSurface& surface, Index cell) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Index p : mesh.points_of_cell(cell)) {
    least = std::min(least, height(surface, mesh.points[p]));
    most = std::max(most, height(surface, mesh.points[p]));
  }
  const double tolerance = rounding * (most - least);
  if (least > tolerance || most < -tolerance) return false;
  return most > tolerance || has_boundary_face_in(mesh, surface, cell, tolerance);
}

// The cells of a layer that are needed to keep its two sides apart. Others are taken back, beginning with those whose
// centres are the farthest from the surface: of a staircase the cells that join its steps.
class Thinning {
 public:
  Thinning(const Mesh& mesh, const FlatSurface& surface, const std::vector<Index>& cells)
      : mesh_(mesh), surface_(surface), on_(mesh.n_cells(), 0) {
    for (const Index c : cells) {
      on_[c] = 1;
      size_ = std::max(size_, std::cbrt(mesh.cell_volume[c]));
    }
  }

  std::vector<Index> needed(std::vector<Index> cells) {
    std::vector<std::pair<long, Index>> in_turn;  // steps of rounding from the surface: machines agree about equal ones
    for (const Index c : cells) in_turn.emplace_back(-std::abs(steps(c)), c);
    std::ranges::sort(in_turn);
    for (const auto& [steps, c] : in_turn)
      if (can_leave(c)) on_[c] = 0;
    std::erase_if(cells, [&](Index c) { return on_[c] == 0; });
    return cells;
  }

 private:
  long steps(Index cell) const { return std::lround(height(surface_, mesh_.cell_centre[cell]) / (rounding * size_)); }

  // Whether no face joins the cell to one that is not of the layer and whose centre is not on the same side. The
  // mirror image of a cell on the boundary is one.
  bool can_leave(Index cell) const {
    const long here = steps(cell);
    if (has_boundary_face_in(mesh_, surface_, cell, rounding * size_)) return false;
    return std::ranges::all_of(mesh_.faces_of_cell(cell), [&](Index f) {
      if (!mesh_.is_interior(f) || on_[mesh_.across(f, cell)] != 0) return true;
      const long there = steps(mesh_.across(f, cell));
      return (here > 0 && there > 0) || (here < 0 && there < 0);
    });
  }

  const Mesh& mesh_;
  const FlatSurface& surface_;
  CellField<char> on_;
  double size_ = 0.0;  // of the layer's largest cell [m]
};

// Vector area of the closed polygon [m^2].
Vector area_of(const std::vector<Vector>& corners) {
  Vector area = Vector::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    area += 0.5 * (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return area;
}

// In the plane with this normal: how often a ray from x crosses the outline is odd within it.
bool is_within(const std::vector<Vector>& corners, const Vector& normal, const Vector& x) {
  const Vector e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
  bool within = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector a = corners[i] - x, b = corners[(i + 1) % corners.size()] - x;
    const double a1 = a.dot(e1), a2 = a.dot(e2), b1 = b.dot(e1), b2 = b.dot(e2);
    if ((a2 > 0.0) != (b2 > 0.0) && a1 - a2 * (b1 - a1) / (b2 - a2) > 0.0) within = !within;
  }
  return within;
}

}  // namespace

FlatSurface disc(const Vector& centre, const Vector& normal, double radius) {
  const Vector n = normal.normalized();
  return {.point = centre, .normal = n, .has_foot = [centre, n, radius](const Vector& x) {
            const Vector r = x - centre;
            return (r - n.dot(r) * n).norm() <= radius;
          }};
}

FlatSurface strip(const Vector& from, const Vector& to, const Vector& front) {
  const Vector along = front.normalized(), line = to - from, across = line - along.dot(line) * along;
  if (!(across.norm() > rounding * line.norm()))
    throw InputError("the two points coincide, or one lies above the other along the front: they span no surface");
  return {.point = from, .normal = along.cross(across).normalized(), .has_foot = [from, across](const Vector& x) {
            const double at = across.dot(x - from) / across.squaredNorm();
            return at >= 0.0 && at <= 1.0;
          }};
}

FlatSurface polygon(const std::vector<Vector>& corners) {
  if (corners.size() < 3) throw InputError("a polygon has at least three corners");
  const Vector area = area_of(corners), normal = area.normalized();
  double size = 0.0;
  for (const Vector& x : corners) size = std::max(size, (x - corners[0]).norm());
  if (!(area.norm() > rounding * size * size)) throw InputError("the corners are collinear: they span no surface");
  for (const Vector& x : corners)
    if (const double off = std::abs(normal.dot(x - corners[0])); off > rounding * size)
      throw InputError(
          fmt::format("the corner {} is {} off the plane of the others", point_text(x, 6), quantity_text(off, "m", 3)));
  return {.point = corners[0], .normal = normal, .has_foot = [corners, normal](const Vector& x) {
            return is_within(corners, normal, x);
          }};
}

std::vector<Index> cells_on(const Mesh& mesh, const FlatSurface& surface) {
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (goes_through(mesh, surface, c) && surface.has_foot(mesh.cell_centre[c])) cells.push_back(c);
  return Thinning(mesh, surface, cells).needed(std::move(cells));
}

}  // namespace pfdm
