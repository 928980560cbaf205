#include "mesh/files/flat_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "physics/error.h"

namespace pfdm {
namespace {

// vtkCellType.h
constexpr int vtk_line = 3, vtk_triangle = 5, vtk_polygon = 7, vtk_pixel = 8, vtk_quadrilateral = 9;
constexpr int vtk_hexahedron = 12, vtk_wedge = 13, vtk_polyhedron = 42;

std::span<const Index> points_of_flat_cell(const MeshFile& file, Index cell) {
  const std::size_t from = file.cell_offsets[cell], to = file.cell_offsets[cell + 1];
  return std::span(file.cell_points).subspan(from, to - from);
}

// Of a cell whose type says how many; 0 where it does not.
std::size_t n_points_of(int type) {
  switch (type) {
    case vtk_line: return 2;
    case vtk_triangle: return 3;
    case vtk_pixel:
    case vtk_quadrilateral: return 4;
    default: return 0;
  }
}

// The points of a face around it.
std::vector<Index> points_around_face(const MeshFile& file, Index cell) {
  const auto given = points_of_flat_cell(file, cell);
  if (const std::size_t due = n_points_of(file.cell_type[cell]); due > 0 && given.size() != due)
    throw InputError(fmt::format("its cell {} has {} points; its type requires {}", cell, given.size(), due));
  std::vector<Index> ids(given.begin(), given.end());
  if (file.cell_type[cell] == vtk_pixel) std::swap(ids[2], ids[3]);
  return ids;
}

class Extrusion {
 public:
  Extrusion(const MeshFile& flat, Index n_points) : flat_(flat), n_points_(n_points) {}

  void add(Index cell, MeshFile& layer) const {
    const int type = flat_.cell_type[cell];
    if (!flat_.is_face(cell) && type != vtk_line) {
      const auto same = points_of_flat_cell(flat_, cell);
      return put(type, {same.begin(), same.end()}, layer);
    }
    const std::vector<Index> ids = points_around_face(flat_, cell);
    if (type == vtk_line) return put(vtk_quadrilateral, {ids[0], ids[1], above(ids[1]), above(ids[0])}, layer);
    std::vector<Index> prism = ids;
    for (const Index p : ids) prism.push_back(above(p));
    if (type == vtk_polygon) layer.polyhedron_faces.push_back(faces_of_prism(prism));
    put(type == vtk_triangle ? vtk_wedge : type == vtk_polygon ? vtk_polyhedron : vtk_hexahedron, prism, layer);
  }

 private:
  Index above(Index point) const { return point + n_points_; }

  static void put(int type, const std::vector<Index>& ids, MeshFile& layer) {
    layer.cell_type.push_back(type);
    layer.cell_points.insert(layer.cell_points.end(), ids.begin(), ids.end());
    layer.cell_offsets.push_back(count_of(layer.cell_points));
  }

  const MeshFile& flat_;
  Index n_points_;
};

}  // namespace

std::vector<Index> faces_of_prism(std::span<const Index> points) {
  const std::size_t n = points.size() / 2;
  std::vector<Index> stream{static_cast<Index>(n + 2), static_cast<Index>(n)};
  stream.insert(stream.end(), points.begin(), points.begin() + n);
  stream.push_back(static_cast<Index>(n));
  stream.insert(stream.end(), points.begin() + n, points.end());
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    for (const Index entry : {Index{4}, points[i], points[next], points[n + next], points[n + i]})
      stream.push_back(entry);
  }
  return stream;
}

std::optional<int> flat_along(const MeshFile& file) {
  std::optional<std::pair<Vector, Vector>> box;
  for (Index c = 0; c < file.n_cells(); ++c) {
    if (file.cell_type[c] > MeshFile::last_flat_type) return std::nullopt;
    if (!file.is_face(c)) continue;
    for (const Index p : points_of_flat_cell(file, c)) {
      const Vector& x = file.points[p];
      if (!box) box = {x, x};
      box = {box->first.cwiseMin(x), box->second.cwiseMax(x)};
    }
  }
  if (!box) return std::nullopt;
  const Vector size = box->second - box->first;
  constexpr double rounding = 1e-9;
  for (const int axis : {2, 1, 0})
    if (size[axis] <= rounding * size.maxCoeff()) return axis;
  return std::nullopt;
}

void extrude(MeshFile& file, int axis, double thickness) {
  const MeshFile flat = file;
  const auto n = count_of(flat.points);
  for (const Vector& x : flat.points) file.points.push_back(x + thickness * Vector::Unit(axis));
  file.cell_type.clear();
  file.cell_points.clear();
  file.cell_offsets = {0};
  const Extrusion extrusion(flat, n);
  for (Index c = 0; c < count_of(flat.cell_type); ++c) extrusion.add(c, file);
  file.region_names = flat.patch_names;
  file.patch_names = flat.line_names;
}

}  // namespace pfdm
