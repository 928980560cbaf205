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
// mean is its area.
double section_area(const Mesh& mesh, Index cell, const Plane& plane, double tolerance) {
  std::vector<Vector> ends;
  for (const Index face : mesh.faces_of_cell(cell)) append_crossings(mesh, face, plane, tolerance, ends);
  Vector centre = Vector::Zero();
  for (const Vector& x : ends) centre += x / static_cast<double>(ends.size());
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
    area += 0.5 * (ends[i] - centre).cross(ends[i + 1] - centre).norm();
  return area;
}

double area_of_faces_in_plane(const Mesh& mesh, Index cell, const Plane& plane, double tolerance) {
  double area = 0.0;
  for (const Index face : mesh.faces_of_cell(cell)) {
    const bool in_plane = std::ranges::all_of(mesh.points_of_face(face), [&](Index p) {
      return std::abs(plane.distance(mesh.points[as_size(p)])) <= tolerance;
    });
    if (in_plane) area += (mesh.is_interior(face) ? 0.5 : 1.0) * mesh.face_area[face].norm();
  }
  return area;
}

double cell_area(const Mesh& mesh, Index cell, const Plane& plane) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Index p : mesh.points_of_cell(cell)) {
    const double s = plane.distance(mesh.points[as_size(p)]);
    lowest = std::min(lowest, s);
    highest = std::max(highest, s);
  }
  const double tolerance = on_plane * std::cbrt(mesh.cell_volume[cell]);
  if (lowest > tolerance || highest < -tolerance) return 0.0;
  if (lowest < -tolerance && highest > tolerance) return section_area(mesh, cell, plane, tolerance);
  return area_of_faces_in_plane(mesh, cell, plane, tolerance);
}

}  // namespace

double damaged_area(const Mesh& mesh, const CellField<double>& damage, const Vector& point, const Vector& normal,
                    double threshold) {
  if (!(normal.norm() > 0.0)) throw InputError("the normal of a slice must not be zero");
  const Plane plane{point, normal.normalized()};
  double area = 0.0;
  for (Index cell = 0; cell < mesh.n_cells(); ++cell)
    if (damage[cell] > threshold) area += cell_area(mesh, cell, plane);
  return area;
}

}  // namespace pfdm
