#include "postproc/fields/slice.h"

#include "mesh/geometry.h"
#include "physics/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double on_plane = 1e-9;  // distance from the plane over the cell's size that counts as on it

struct Plane {
  Vector point;
  Vector normal;  // unit length
  double distance(const Vector& x) const { return normal.dot(x - point); }
};

// Signed area, about a point of the plane, of the segments in which a face, a fan of triangles, crosses it; the centre
// is times that area. Points on the plane count as above it, so that an edge in the plane belongs to exactly one of the
// faces that meet in it.
Section swept_by_face(const Mesh& mesh, Index face, const Plane& plane, double tolerance, const Vector& origin) {
  const auto points = mesh.points_of_face(face);
  const Vector middle = fan_middle(mesh, face);
  Section swept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::array<Vector, 3> corners{mesh.points[points[i]], mesh.points[points[(i + 1) % points.size()]], middle};
    Vector up = origin, down = origin;  // where the triangle's outline passes to the plane's upper side, and back
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector &a = corners[k], &b = corners[(k + 1) % 3];
      const double s = plane.distance(a), t = plane.distance(b);
      if ((s < -tolerance) == (t < -tolerance)) continue;
      (t < -tolerance ? down : up) = a + std::clamp(s / (s - t), 0.0, 1.0) * (b - a);
    }
    const double area = 0.5 * plane.normal.dot((up - origin).cross(down - origin));
    swept.area += area;
    swept.centre += area * (origin + up + down) / 3.0;
  }
  return swept;
}

// The segments bound the cell's section, whatever its shape.
Section section_through(const Mesh& mesh, Index cell, const Plane& plane, double tolerance) {
  const Vector origin = mesh.cell_centre[cell] - plane.distance(mesh.cell_centre[cell]) * plane.normal;
  Section section;
  for (const Index face : mesh.faces_of_cell(cell)) {
    const Section swept = swept_by_face(mesh, face, plane, tolerance, origin);
    const double sign = mesh.outwards(face, cell);
    section.area += sign * swept.area;
    section.centre += sign * swept.centre;
  }
  section.centre = section.area != 0.0 ? Vector(section.centre / section.area) : origin;
  section.area = std::abs(section.area);
  return section;
}

Section faces_in_plane(const Mesh& mesh, Index cell, const Plane& plane, double tolerance) {
  Section section;
  for (const Index face : mesh.faces_of_cell(cell)) {
    const auto is_on = [&](const Vector& x) { return std::abs(plane.distance(x)) <= tolerance; };
    const bool in_plane = is_on(fan_middle(mesh, face)) && std::ranges::all_of(mesh.points_of_face(face), [&](Index p) {
                            return is_on(mesh.points[p]);
                          });
    if (!in_plane) continue;
    section.area += (mesh.is_interior(face) ? 0.5 : 1.0) * mesh.face_area[face].norm();
    section.centre = mesh.face_centre[face];  // a convex cell has one such face
  }
  return section;
}

}  // namespace

Section section_of_cell(const Mesh& mesh, Index cell, const Vector& point, const Vector& normal) {
  const Plane plane{point, normal};
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  const auto reach = [&](const Vector& x) {
    lowest = std::min(lowest, plane.distance(x));
    highest = std::max(highest, plane.distance(x));
  };
  for (const Index p : mesh.points_of_cell(cell)) reach(mesh.points[p]);
  for (const Index face : mesh.faces_of_cell(cell)) reach(fan_middle(mesh, face));
  const double tolerance = on_plane * std::cbrt(mesh.cell_volume[cell]);
  if (lowest > tolerance || highest < -tolerance) return {};
  if (lowest < -tolerance && highest > tolerance) return section_through(mesh, cell, plane, tolerance);
  return faces_in_plane(mesh, cell, plane, tolerance);
}

double damaged_area(const Mesh& mesh, const CellField<double>& damage, const Vector& point, const Vector& normal,
                    double threshold) {
  if (!(normal.norm() > 0.0)) throw InputError("the normal of a slice must not be zero");
  const Vector unit = normal.normalized();
  double area = 0.0;
  for (Index cell = 0; cell < mesh.n_cells(); ++cell)
    if (damage[cell] > threshold) area += section_of_cell(mesh, cell, point, unit).area;
  return area;
}

}  // namespace pfdm
