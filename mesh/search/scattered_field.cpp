#include "mesh/search/scattered_field.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "physics/error.h"

namespace pfdm {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

void require_distinct(std::size_t vertices, std::size_t points) {
  if (vertices != points)
    throw InputError(fmt::format("{} of the {} points are at the place of another one", points - vertices, points));
}

CellSoup tetrahedra_between(const std::vector<Vector>& points) {
  using Base = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
  using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Base>>;
  std::vector<std::pair<Kernel::Point_3, Index>> numbered;
  for (const Vector& x : points) numbered.emplace_back(Kernel::Point_3(x[0], x[1], x[2]), numbered.size());
  const Triangulation delaunay(numbered.begin(), numbered.end());
  require_distinct(delaunay.number_of_vertices(), points.size());
  if (delaunay.dimension() < 3) throw InputError("the points lie in a plane: name but the coordinates along it");
  CellSoup soup;
  soup.points = points;
  for (const auto& cell : delaunay.finite_cell_handles())
    soup.add_cell(
        CellShape::tetrahedron,
        std::array{cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()},
        0);
  return soup;
}

/// Wedges of this height along `across` over the triangles between points of a plane.
CellSoup wedges_between(const std::vector<Vector>& points, int across, double height) {
  using Base = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Base>>;
  const int first = (across + 1) % 3, second = (across + 2) % 3;
  std::vector<std::pair<Kernel::Point_2, Index>> numbered;
  for (const Vector& x : points) numbered.emplace_back(Kernel::Point_2(x[first], x[second]), numbered.size());
  const Triangulation delaunay(numbered.begin(), numbered.end());
  require_distinct(delaunay.number_of_vertices(), points.size());
  if (delaunay.dimension() < 2) throw InputError("the points lie on a line: name but one coordinate along it");
  CellSoup soup;
  soup.points = points;
  for (const Vector& x : points) soup.points.push_back(x + height * Vector::Unit(across));
  const auto n = count_of(points);
  for (const auto& face : delaunay.finite_face_handles()) {
    const Index a = face->vertex(0)->info(), b = face->vertex(1)->info(), c = face->vertex(2)->info();
    soup.add_cell(CellShape::wedge, std::array{a, b, c, a + n, b + n, c + n}, 0);
  }
  return soup;
}

/// Hexahedra between points that rise along an axis, of this height and width.
CellSoup intervals_between(const std::vector<Vector>& points, int axis, double height) {
  std::vector<Index> order = counted_from_zero(points.size());
  std::ranges::sort(order, {}, [&](Index i) { return points[i][axis]; });
  CellSoup soup;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  for (const auto& [up, on] : {std::pair{0.0, 0.0}, {height, 0.0}, {height, height}, {0.0, height}})
    for (const Vector& x : points) soup.points.push_back(x + up * Vector::Unit(first) + on * Vector::Unit(second));
  const auto n = count_of(points);
  std::size_t n_alike = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Index a = order[i - 1], b = order[i];
    if (!(points[a][axis] < points[b][axis])) ++n_alike;
    soup.add_cell(CellShape::hexahedron, std::array{a, a + n, a + 2 * n, a + 3 * n, b, b + n, b + 2 * n, b + 3 * n}, 0);
  }
  require_distinct(points.size() - n_alike, points.size());
  return soup;
}

CellSoup cells_between(const std::vector<Vector>& points, const std::array<bool, 3>& varies, double height) {
  const auto n = std::ranges::count(varies, true);
  if (n == 3) return tetrahedra_between(points);
  const auto axis = static_cast<int>(std::ranges::find(varies, n == 1) - varies.begin());
  return n == 2 ? wedges_between(points, axis, height) : intervals_between(points, axis, height);
}

}  // namespace

KnownField scattered_field(const std::vector<Vector>& points, const std::array<bool, 3>& varies) {
  std::vector<Vector> within = points;
  for (Vector& x : within)
    for (std::size_t a = 0; a < 3; ++a)
      if (!varies[a]) x[a] = 0.0;
  const double height = within.empty() ? 0.0 : size_of(within);
  if (within.size() < 2 || !(height > 0.0)) throw InputError("two points or more are needed, at places of their own");
  KnownField field{.places = KnownPlaces(cells_between(within, varies, height)),
                   .at_points = true,
                   .entry = {},
                   .varies = varies,
                   .fixed = Vector::Constant(0.5 * height)};
  for (Index p = 0; p < field.places.n_points(); ++p) field.entry.push_back(p % count_of(points));
  return field;
}

}  // namespace pfdm
