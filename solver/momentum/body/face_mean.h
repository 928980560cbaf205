#pragma once
// Means over a face of what a boundary condition prescribes on it.

#include "mesh/mesh.h"
#include "physics/error.h"

#include <utility>

namespace pfdm {

/// Mean over the face of value(x), a number or a vector that depends on the place x [m]. By a rule that is exact for
/// quadratics, in each triangle about the face's centre: the value at the centre may be far from the mean, as that of
/// the shear stress of a beam of few layers is (12 % with two). Points are within the triangles, as the value may jump
/// at edges. A field out of a file that does not reach so far (InputError) has its value at the centre.
template <class Value>
auto mean_over_face(const Mesh& mesh, Index face, const Value& value) {
  const Vector& centre = mesh.face_centre[face];
  auto middle = value(centre);
  const Vector n = mesh.face_area[face].normalized();
  const auto points = mesh.points_of_face(face);
  auto differences = middle;
  differences *= 0.0;
  double area = 0.0;
  try {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector a = mesh.points[points[i]] - centre, b = mesh.points[points[(i + 1) % points.size()]] - centre;
      const double third = a.cross(b).dot(n) / 6.0;
      for (const auto& [of_a, of_b] : {std::pair{1.0, 1.0}, {4.0, 1.0}, {1.0, 4.0}})
        differences += third * (value(Vector(centre + (of_a * a + of_b * b) / 6.0)) - middle);
      area += 3.0 * third;
    }
  } catch (const InputError&) {
    return middle;
  }
  differences *= 1.0 / area;
  differences += middle;
  return differences;
}

}  // namespace pfdm
