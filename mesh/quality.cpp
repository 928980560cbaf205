#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "mesh/cell_edges.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr std::array<const char*, 5> shape_names{"tetrahedra", "wedges", "pyramids", "hexahedra", "polyhedra"};

double angle_between(const Vector& a, const Vector& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) * degrees; }

struct FaceQuality {
  double non_orthogonality, skewness, volume_ratio;
};

FaceQuality face_quality(const Mesh& mesh, Index face) {
  const Index p = mesh.owner[face];
  const Index n = mesh.neighbour[face];
  const Vector line = mesh.cell_centre[n] - mesh.cell_centre[p];
  const Vector& area = mesh.face_area[face];
  const Vector to_face = mesh.face_centre[face] - mesh.cell_centre[p];
  const Vector pierced = (to_face.dot(area) / line.dot(area)) * line;
  const double a = mesh.cell_volume[p];
  const double b = mesh.cell_volume[n];
  return {angle_between(line, area), (to_face - pierced).norm() / line.norm(), std::max(a, b) / std::min(a, b)};
}

double dihedral_angle(const Mesh& mesh, Index cell, Index f, Index g) {
  return 180.0 - angle_between(mesh.outward_area(f, cell), mesh.outward_area(g, cell));
}

Statistic statistic(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [min, max] = std::ranges::minmax(values);
  return {min, std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()), max};
}

void count_cells(const Mesh& mesh, MeshQuality& quality) {
  std::array<Index, shape_names.size()> by_shape{};
  std::vector<Index> by_region(mesh.region_names.size(), 0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    ++by_shape[static_cast<std::size_t>(mesh.shape[c])];
    ++by_region[mesh.region[c]];
  }
  for (std::size_t s = 0; s < by_shape.size(); ++s)
    if (by_shape[s] > 0) quality.shapes.emplace_back(shape_names[s], by_shape[s]);
  for (std::size_t r = 0; r < by_region.size(); ++r) quality.regions.emplace_back(mesh.region_names[r], by_region[r]);
  for (const Patch& patch : mesh.patches) quality.patches.emplace_back(patch.name, patch.n_faces);
}

double smallest_dihedral_angle(const Mesh& mesh, Index cell, const std::vector<CellEdge>& edges) {
  double smallest = 180.0;
  for (const CellEdge& edge : edges)
    smallest = std::min(smallest, dihedral_angle(mesh, cell, edge.faces[0], edge.faces[1]));
  return smallest;
}

void measure_faces(const Mesh& mesh, MeshQuality& quality) {
  std::vector<double> non_orthogonality, skewness, volume_ratio;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const FaceQuality face = face_quality(mesh, f);
    non_orthogonality.push_back(face.non_orthogonality);
    skewness.push_back(face.skewness);
    volume_ratio.push_back(face.volume_ratio);
  }
  quality.non_orthogonality = statistic(non_orthogonality);
  quality.skewness = statistic(skewness);
  quality.volume_ratio = statistic(volume_ratio);
}

}  // namespace

CellQuality cell_quality(const Mesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.n_cells());
  CellQuality quality{CellField<double>(n), CellField<double>(n), CellField<double>(n, 1.0), CellField<double>(n, 1.0),
                      CellField<double>(n, 180.0)};
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const FaceQuality face = face_quality(mesh, f);
    for (const Index c : {mesh.owner[f], mesh.neighbour[f]}) {
      quality.non_orthogonality[c] = std::max(quality.non_orthogonality[c], face.non_orthogonality);
      quality.skewness[c] = std::max(quality.skewness[c], face.skewness);
      quality.volume_ratio[c] = std::max(quality.volume_ratio[c], face.volume_ratio);
    }
  }
  std::vector<CellEdge> edges;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    list_edges(mesh, c, edges);
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0.0;
    for (const CellEdge& edge : edges) {
      const double length = (mesh.points[edge.high] - mesh.points[edge.low]).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    quality.aspect_ratio[c] = longest / shortest;
    quality.min_dihedral_angle[c] = smallest_dihedral_angle(mesh, c, edges);
  }
  return quality;
}

MeshQuality mesh_quality(const Mesh& mesh) {
  MeshQuality quality;
  quality.n_points = count_of(mesh.points);
  quality.n_faces = mesh.n_faces();
  quality.n_cells = mesh.n_cells();
  count_cells(mesh, quality);
  quality.volume = std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0);
  quality.cell_volume = statistic(mesh.cell_volume.values());
  measure_faces(mesh, quality);
  const CellQuality cells = cell_quality(mesh);
  quality.aspect_ratio = statistic(cells.aspect_ratio.values());
  quality.min_dihedral_angle = statistic(cells.min_dihedral_angle.values());
  return quality;
}

std::optional<std::string> flat_cell_warning(const Mesh& mesh) {
  constexpr double least = 0.5;  // [degrees]
  double smallest = least;
  Index c = -1;
  std::vector<CellEdge> edges;
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) {
    list_edges(mesh, cell, edges);
    const double angle = smallest_dihedral_angle(mesh, cell, edges);
    if (angle < smallest) smallest = angle, c = cell;
  }
  if (c < 0) return std::nullopt;
  const Vector& x = mesh.cell_centre[c];
  return fmt::format(
      "cell {} at ({:.4g}, {:.4g}, {:.4g}) m is flat or a needle: two of its faces meet at {:.2g} degrees. Equations "
      "on such cells are hardly solved. Take smaller triangles or cells there (mesh.size_far, surface_size), or "
      "surfaces "
      "and sides that are farther apart; pfdm mesh measures all cells",
      c, x[0], x[1], x[2], smallest);
}

}  // namespace pfdm
