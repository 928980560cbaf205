#include "mesh/geometry.h"

#include <span>
#include <vector>

namespace pfdm {
namespace {

Vector mean_point(const std::vector<Vector>& points, std::span<const Index> ids) {
  Vector sum = Vector::Zero();
  for (const Index p : ids) sum += points[p] - points[ids[0]];
  return points[ids[0]] + sum / static_cast<double>(ids.size());
}

// Calls with the two rim points of each triangle of the fan.
template <class Function>
void for_each_rim_edge(const std::vector<Vector>& points, std::span<const Index> face, Function&& function) {
  for (std::size_t i = 0; i < face.size(); ++i) function(points[face[i]], points[face[(i + 1) % face.size()]]);
}

struct CellSums {
  double volume = 0.0;
  Vector moment = Vector::Zero();  // integral of x - reference
};

// The part between a face and the reference point; sign -1 if the face's normal points into the cell.
void add_face(CellSums& sums, const Mesh& mesh, Index face, const Vector& reference, double sign) {
  const auto ids = mesh.points_of_face(face);
  const Vector middle = fan_middle(mesh, face) - reference;
  for_each_rim_edge(mesh.points, ids, [&](const Vector& p, const Vector& q) {
    const Vector a = p - reference;
    const Vector b = q - reference;
    const double volume = sign * middle.dot(a.cross(b)) / 6.0;
    sums.volume += volume;
    sums.moment += volume * 0.25 * (middle + a + b);
  });
}

void compute_cell(Mesh& mesh, Index cell) {
  const auto faces = mesh.faces_of_cell(cell);
  Vector reference = Vector::Zero();
  for (const Index f : faces) reference += mesh.face_centre[f] - mesh.face_centre[faces[0]];
  reference = mesh.face_centre[faces[0]] + reference / static_cast<double>(faces.size());
  CellSums sums;
  for (const Index f : faces) add_face(sums, mesh, f, reference, mesh.outwards(f, cell));
  mesh.cell_volume[cell] = sums.volume;
  mesh.cell_centre[cell] = sums.volume > 0.0 ? Vector(reference + sums.moment / sums.volume) : reference;
}

FaceGeometry fan_geometry(const std::vector<Vector>& points, std::span<const Index> face, const Vector& middle) {
  Vector area = Vector::Zero();
  for_each_rim_edge(points, face,
                    [&](const Vector& p, const Vector& q) { area += 0.5 * (p - middle).cross(q - middle); });
  const double size = area.norm();
  if (size == 0.0) return {area, middle};
  const Vector normal = area / size;
  Vector moment = Vector::Zero();
  for_each_rim_edge(points, face, [&](const Vector& p, const Vector& q) {
    const double part = 0.5 * (p - middle).cross(q - middle).dot(normal);
    moment += part * ((p - middle) + (q - middle)) / 3.0;
  });
  return {area, middle + moment / size};
}

}  // namespace

FaceGeometry face_geometry(const std::vector<Vector>& points, std::span<const Index> face) {
  return fan_geometry(points, face, mean_point(points, face));
}

Vector fan_middle(const Mesh& mesh, Index face) {
  if (mesh.face_apex.size() > 0) return mesh.points[mesh.face_apex[face]];
  return mean_point(mesh.points, mesh.points_of_face(face));
}

Tensor face_warp(const Mesh& mesh, Index face) {
  const Vector middle = fan_middle(mesh, face);
  Tensor warp = Tensor::Zero();
  for_each_rim_edge(mesh.points, mesh.points_of_face(face), [&](const Vector& p, const Vector& q) {
    const Vector area = 0.5 * (p - middle).cross(q - middle);
    warp += area * ((p + q + middle) / 3.0 - mesh.face_centre[face]).transpose();
  });
  return warp;
}

void compute_geometry(Mesh& mesh) {
  const auto n_faces = static_cast<std::size_t>(mesh.n_faces());
  const auto n_cells = static_cast<std::size_t>(mesh.n_cells());
  mesh.face_area = FaceField<Vector>(n_faces, Vector::Zero());
  mesh.face_centre = FaceField<Vector>(n_faces, Vector::Zero());
  mesh.cell_centre = CellField<Vector>(n_cells, Vector::Zero());
  mesh.cell_volume = CellField<double>(n_cells);
  for (Index f = 0; f < mesh.n_faces(); ++f) {
    const FaceGeometry geometry = fan_geometry(mesh.points, mesh.points_of_face(f), fan_middle(mesh, f));
    mesh.face_area[f] = geometry.area;
    mesh.face_centre[f] = geometry.centre;
  }
  for (Index c = 0; c < mesh.n_cells(); ++c) compute_cell(mesh, c);
}

Vector doubled_fan_area(const std::vector<Vector>& points, std::span<const Index> loop, Index apex) {
  const Vector& o = points[apex];
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (points[loop[i]] - o).cross(points[loop[(i + 1) % loop.size()]] - o);
  return sum;
}

std::vector<Vector> sums_by_patch(const Mesh& mesh, const std::vector<Vector>& of_boundary_faces) {
  std::vector<Vector> sums(mesh.patches.size(), Vector::Zero());
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (Index f = 0; f < mesh.patches[p].n_faces; ++f)
      sums[p] += of_boundary_faces[mesh.patches[p].first_face + f - mesh.n_interior_faces()];
  return sums;
}

}  // namespace pfdm
