#include "solver/homogenization/box_sides.h"

#include "mesh/bounding_box.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

namespace pfdm {
namespace {

constexpr double side_tolerance = 1e-6;  // of the box's edges, and of areas
constexpr std::array<std::string_view, 6> side_names{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

// The side that a boundary face lies in; 6: none.
std::size_t side_of(const Mesh& mesh, const BoxSides& sides, Index face) {
  const Vector size = sides.upper - sides.lower, n = mesh.face_area[face].normalized();
  const Vector& x = mesh.face_centre[face];
  for (int axis = 0; axis < 3; ++axis)
    for (const bool at_end : {false, true}) {
      const double plane = at_end ? sides.upper[axis] : sides.lower[axis];
      if (std::abs(x[axis] - plane) < side_tolerance * size[axis] &&
          (at_end ? n[axis] : -n[axis]) > 1.0 - side_tolerance)
        return as_size(2 * axis + (at_end ? 1 : 0));
    }
  return 6;
}

void require_covered(const Mesh& mesh, const BoxSides& sides) {
  const Vector size = sides.upper - sides.lower;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto axis = static_cast<Index>(s / 2);
    const double due = size.prod() / size[axis];
    double area = 0.0;
    for (const Index face : sides.faces[s]) area += mesh.face_area[face].norm();
    if (std::abs(area - due) > side_tolerance * due)
      throw InputError(
          fmt::format("the faces of the body in the plane of {} cover {:.4g} % of that side of the box around it; "
                      "homogenisation needs a body that fills a box whose edges are along x, y and z (voids inside it "
                      "are allowed)",
                      side_names[s], 100.0 * area / due));
  }
}

// Faces of a side by their places across the axis, in cells of a grid that is much coarser than the tolerance.
class FacesByPlace {
 public:
  FacesByPlace(const Mesh& mesh, const std::vector<Index>& faces, int axis, double near)
      : mesh_(mesh), axis_(axis), near_(near) {
    for (const Index face : faces) places_.emplace(cell_of(mesh.face_centre[face]), face);
  }

  // -1: there is none.
  Index find(const Vector& x) const {
    const auto [u, v] = cell_of(x);
    for (std::int64_t du = -1; du <= 1; ++du)
      for (std::int64_t dv = -1; dv <= 1; ++dv) {
        const auto [first, last] = places_.equal_range({u + du, v + dv});
        for (auto it = first; it != last; ++it) {
          Vector apart = mesh_.face_centre[it->second] - x;
          apart[axis_] = 0.0;
          if (apart.norm() < near_) return it->second;
        }
      }
    return -1;
  }

 private:
  using Place = std::pair<std::int64_t, std::int64_t>;
  Place cell_of(const Vector& x) const {
    const double width = 100.0 * near_;
    return {std::llround(x[(axis_ + 1) % 3] / width), std::llround(x[(axis_ + 2) % 3] / width)};
  }

  const Mesh& mesh_;
  int axis_;
  double near_;
  std::multimap<Place, Index> places_;
};

Index nearest_face(const Mesh& mesh, const std::vector<Index>& faces, const Vector& x) {
  return *std::ranges::min_element(faces, {}, [&](Index f) { return (mesh.face_centre[f] - x).squaredNorm(); });
}

}  // namespace

std::vector<Index> BoxSides::all() const {
  std::vector<Index> all;
  for (const std::vector<Index>& side : faces) all.insert(all.end(), side.begin(), side.end());
  return all;
}

BoxSides find_box_sides(const Mesh& mesh) {
  BoxSides sides;
  const Box around = bounding_box(mesh.points);
  sides.lower = around.low;
  sides.upper = around.high;
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
    if (const std::size_t side = side_of(mesh, sides, f); side < 6) sides.faces[side].push_back(f);
  require_covered(mesh, sides);
  return sides;
}

std::vector<PeriodicFaces> match_opposite_sides(const Mesh& mesh, const BoxSides& sides) {
  std::vector<PeriodicFaces> pairs;
  const double alike = side_tolerance * (sides.upper - sides.lower).minCoeff();
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Index>&low = sides.faces[2 * axis], &high = sides.faces[2 * axis + 1];
    const FacesByPlace places(mesh, high, axis, alike);
    for (const Index face : low) {
      const Index image = places.find(mesh.face_centre[face]);
      const double area = mesh.face_area[face].norm();
      if (image < 0 || low.size() != high.size() ||
          std::abs(mesh.face_area[image].norm() - area) > side_tolerance * area)
        throw InputError(fmt::format(
            "the faces of {} and {} do not match: that of {} at ({:.4g}, {:.4g}, {:.4g}) m has no translate on the "
            "other side; periodic boundary conditions need a mesh whose opposite sides are cut alike, the others do "
            "not",
            side_names[2 * axis], side_names[2 * axis + 1], side_names[2 * axis], mesh.face_centre[face][0],
            mesh.face_centre[face][1], mesh.face_centre[face][2]));
      pairs.push_back({face, image});
    }
  }
  return pairs;
}

std::vector<HeldFace> three_two_one_supports(const Mesh& mesh, const BoxSides& sides) {
  const auto corner = [&](bool along_x, bool along_y) {
    return nearest_face(
        mesh, sides.faces[4],
        {along_x ? sides.upper[0] : sides.lower[0], along_y ? sides.upper[1] : sides.lower[1], sides.lower[2]});
  };
  const Vector all = Vector::Ones(), yz(0.0, 1.0, 1.0), z(0.0, 0.0, 1.0);
  return {{corner(false, false), all.asDiagonal()},
          {corner(true, false), yz.asDiagonal()},
          {corner(false, true), z.asDiagonal()}};
}

}  // namespace pfdm
