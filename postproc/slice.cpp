#include "postproc/slice.h"

#include "physics/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pfdm {
namespace {

constexpr double on_plane = 1e-9;  // distance from the plane over the cell's size that counts as on it

struct Plane {
  Vector point;
  Vector normal;  // unit length
  double distance(const Vector& x) const { return normal.dot(x - point); }
};

// Points where the outline of a face crosses the plane. Points on the plane count as above it, so that an edge in the
// plane belongs to exactly one of the faces that meet in it.
void append_crossings(const Mesh& mesh, Index face, const Plane& plane, double tolerance, std::vector<Vector>& ends) {
  const auto points = mesh.points_of_face(face);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector& a = mesh.points[as_size(points[i])];
    const Vector& b = mesh.points[as_size(points[(i + 1) % points.size()])];
    const double s = plane.distance(a), t = plane.distance(b);
    if ((s < -tolerance) == (t < -tolerance)) continue;
    ends.emplace_back(a + std::clamp(s / (s - t), 0.0, 1.0) * (b - a));
  }
}

// The segments in which the faces of a convex cell cross the plane bound its section: the fan of triangles from their
// mean makes it up.
Section section_through(const Mesh& mesh, Index cell, const Plane& plane, double tolerance) {
  std::vector<Vector> ends;
  for (const Index face : mesh.faces_of_cell(cell)) append_crossings(mesh, face, plane, tolerance, ends);
  Vector mean = Vector::Zero();
  for (const Vector& x : ends) mean += x / static_cast<double>(ends.size());
  Section section;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    const double area = 0.5 * (ends[i] - mean).cross(ends[i + 1] - mean).norm();
    section.area += area;
    section.centre += area * (ends[i] + ends[i + 1] + mean) / 3.0;
  }
  section.centre = section.area > 0.0 ? Vector(section.centre / section.area) : mean;
  return section;
}

Section faces_in_plane(const Mesh& mesh, Index cell, const Plane& plane, double tolerance) {
  Section section;
  for (const Index face : mesh.faces_of_cell(cell)) {
    const bool in_plane = std::ranges::all_of(mesh.points_of_face(face), [&](Index p) {
      return std::abs(plane.distance(mesh.points[as_size(p)])) <= tolerance;
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
  for (const Index p : mesh.points_of_cell(cell)) {
    const double s = plane.distance(mesh.points[as_size(p)]);
    lowest = std::min(lowest, s);
    highest = std::max(highest, s);
  }
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
