#include "postproc/browser/body_part.h"

#include "mesh/bounding_box.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace pfdm {
namespace {

using Corners = std::vector<std::vector<int>>;

/// Faces of a shape by its corners, outwards (VTK's order).
const Corners& faces_of(std::uint8_t shape) {
  static const Corners tetrahedron{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  static const Corners pyramid{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  static const Corners wedge{{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const Corners hexahedron{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  switch (shape) {
    case 4: return tetrahedron;
    case 5: return pyramid;
    case 6: return wedge;
    default: return hexahedron;
  }
}

/// Two least points and the last one: no two faces of a mesh share three points.
using FaceKey = std::array<Index, 3>;

FaceKey key_of(std::span<const Index> corners) {
  std::array<Index, 2> least{corners[0], corners[1]};
  if (least[1] < least[0]) std::swap(least[0], least[1]);
  Index last = least[1];
  for (const Index p : corners.subspan(2)) {
    last = std::max(last, p);
    if (p < least[0]) {
      least = {p, least[0]};
    } else if (p < least[1]) {
      least[1] = p;
    }
  }
  return {least[0], least[1], last};
}

/// Whether each face, in the order of for_each_face(), is that of one cell alone.
std::vector<std::uint8_t> lone_faces(const std::vector<std::uint8_t>& shapes, const std::vector<Index>& corners,
                                     const std::vector<Index>& faces) {
  std::vector<FaceKey> keys;
  for_each_face(shapes, corners, faces,
                [&](std::size_t, std::span<const Index> face) { keys.push_back(key_of(face)); });
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::vector<std::uint8_t> lone(keys.size(), 1);
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    if (keys[order[i]] == keys[order[i + 1]]) lone[order[i]] = lone[order[i + 1]] = 0;
  return lone;
}

/// Corners in one stretch; calls `see` with each cell's.
void each_cell(const std::vector<std::uint8_t>& shapes, const std::vector<Index>& corners,
               const std::vector<Index>& faces, const std::function<void(std::size_t, std::span<const Index>)>& see) {
  std::size_t at = 0, face = 0;
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    std::size_t n = shapes[cell];
    if (n == 0)
      for (Index rest = faces[face++]; rest > 0; --rest) n += faces[face++];
    see(cell, std::span(corners).subspan(at, n));
    at += n;
  }
}

/// Cells and points of the unparted mesh; the points that no chosen cell has are left out.
void take_mesh(Body& body, const StoredCells& mesh, const std::vector<Index>& cells) {
  const std::vector<std::uint8_t> shapes = mesh.shapes();
  const std::vector<double> regions =
      mesh.has("material") ? mesh.values("material") : std::vector<double>(shapes.size(), 0.0);
  for (const Index cell : cells) {
    body.shape.push_back(shapes[cell]);
    body.region.push_back(static_cast<std::uint8_t>(std::min(255.0, regions[cell])));
    mesh.append_corners(cell, body.corners, body.faces);
  }
  const std::vector<Vector> points = mesh.points();
  std::vector<Index> number(points.size(), -1);
  for (Index& corner : body.corners) {
    Index& mine = number[corner];
    if (mine < 0) {
      mine = count_of(body.points);
      body.points.push_back(points[corner]);
      body.place.push_back(mine);
    }
    corner = mine;
  }
}

/// The axis across which a plane through the middle meets every cell.
int flat_axis_of(const Body& body) {
  std::array<bool, 3> flat{true, true, true};
  const auto [lower, upper] = bounding_box(body.points);
  const Vector middle = 0.5 * (lower + upper) + 1e-6 * (upper - lower);
  for_each_cell(body, [&](std::size_t, std::span<const Index> corners) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](Index p) { return body.points[p][axis]; };
      const auto [low, high] = std::ranges::minmax(corners, {}, at);
      flat[axis] = flat[axis] && at(low) <= middle[axis] && at(high) >= middle[axis];
    }
  });
  for (const int axis : {2, 1, 0})
    if (flat[axis]) return axis;
  return -1;
}

}  // namespace

void for_each_cell(const Body& body, const std::function<void(std::size_t, std::span<const Index>)>& see) {
  each_cell(body.shape, body.corners, body.faces, see);
}

void for_each_face(const std::vector<std::uint8_t>& shapes, const std::vector<Index>& corners,
                   const std::vector<Index>& faces,
                   const std::function<void(std::size_t, std::span<const Index>)>& see) {
  std::size_t at = 0, face = 0;
  std::vector<Index> rim;
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    if (shapes[cell] == 0) {
      for (Index rest = faces[face++]; rest > 0; --rest) {
        const std::size_t n = faces[face++];
        see(cell, std::span(corners).subspan(at, n));
        at += n;
      }
      continue;
    }
    for (const std::vector<int>& of : faces_of(shapes[cell])) {
      rim.clear();
      for (const int k : of) rim.push_back(corners[at + k]);
      see(cell, rim);
    }
    at += shapes[cell];
  }
}

BodyPart part_of(const StoredCells& mesh, const std::vector<Vector>& points, const Vector& cut_at, Index most) {
  BodyPart part;
  if (mesh.n_cells() <= most) {
    part.cells.resize(mesh.n_cells());
    std::iota(part.cells.begin(), part.cells.end(), Index{0});
    return part;
  }
  const std::vector<std::uint8_t> shapes = mesh.shapes();
  std::vector<Index> corners, faces;
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) mesh.append_corners(cell, corners, faces);
  const std::vector<std::uint8_t> lone = lone_faces(shapes, corners, faces);
  std::vector<std::uint8_t> seen(shapes.size(), 0);
  std::size_t f = 0;
  for_each_face(shapes, corners, faces, [&](std::size_t cell, std::span<const Index>) { seen[cell] |= lone[f++]; });
  each_cell(shapes, corners, faces, [&](std::size_t cell, std::span<const Index> of) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto at = [&](Index p) { return points[p][axis]; };
      const auto [low, high] = std::ranges::minmax(of, {}, at);
      if (at(low) <= cut_at[axis] && at(high) >= cut_at[axis]) seen[cell] = 1;
    }
  });
  std::vector<std::uint8_t> chosen_shapes;
  std::vector<Index> chosen_corners, chosen_faces;
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) {
    if (seen[cell] == 0) continue;
    part.cells.push_back(cell);
    chosen_shapes.push_back(shapes[cell]);
    mesh.append_corners(cell, chosen_corners, chosen_faces);
  }
  const std::vector<std::uint8_t> lone_in_part = lone_faces(chosen_shapes, chosen_corners, chosen_faces);
  std::size_t k = 0;
  f = 0;
  for_each_face(shapes, corners, faces, [&](std::size_t cell, std::span<const Index>) {
    const std::uint8_t is_surface = lone[f++];
    if (seen[cell] != 0 && lone_in_part[k++] != 0) part.is_surface.push_back(is_surface);
  });
  return part;
}

Body resting_body(const StoredCells& mesh, const BodyPart& part) {
  Body body;
  take_mesh(body, mesh, part.cells);
  body.is_surface = part.is_surface;
  body.flat_axis = flat_axis_of(body);
  return body;
}

}  // namespace pfdm
