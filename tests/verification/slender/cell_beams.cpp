#include "tests/verification/slender/cell_beams.h"

#include "mesh/dual.h"
#include "mesh/patch_rules.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace pfdm::verification {
namespace {

// Of the point number i of n + 1 along an axis; ends stay.
double moved(Index i, Index n, double noise, Index seed) {
  const double wave = 43758.5453 * std::sin(12.9898 * static_cast<double>(seed) + 78.233);
  const double part = i > 0 && i < n ? noise * (wave - std::floor(wave) - 0.5) : 0.0;
  return (static_cast<double>(i) + part) / static_cast<double>(n);
}

using Corner = std::function<Index(int, int, int)>;

double volume_of(const CellSoup& soup, const std::array<Index, 4>& p) {
  const auto from_first = [&](std::size_t k) -> Vector { return soup.points[p[k]] - soup.points[p[0]]; };
  return from_first(1).cross(from_first(2)).dot(from_first(3));
}

void add_tetrahedron(CellSoup& soup, std::array<Index, 4> p) {
  if (volume_of(soup, p) < 0.0) std::swap(p[1], p[2]);
  soup.add_cell(CellShape::tetrahedron, p, 0);
}

// Between two triangles, the first of whose normals points outwards.
void add_prism(CellSoup& soup, std::array<Index, 6> p) {
  if (volume_of(soup, {p[0], p[1], p[2], p[3]}) > 0.0) {
    std::swap(p[1], p[2]);
    std::swap(p[4], p[5]);
  }
  soup.add_cell(CellShape::wedge, p, 0);
}

// corner(a, b, s): a and b within the triangles' plane, s along their axis.
void add_two_prisms(CellSoup& soup, const Corner& corner, bool is_turned) {
  const auto at = [&](int a, int b, int s) { return is_turned ? corner(1 - a, b, s) : corner(a, b, s); };
  add_prism(soup, {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1)});
  add_prism(soup, {at(0, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 1, 1), at(0, 1, 1)});
}

// One for each order in which the axes are followed from one corner to the opposite one.
void add_six_tetrahedra(CellSoup& soup, const Corner& corner) {
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    std::array<int, 3> x{0, 0, 0};
    std::array<Index, 4> p{corner(0, 0, 0), 0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      x[order[k]] = 1;
      p[k + 1] = corner(x[0], x[1], x[2]);
    }
    add_tetrahedron(soup, p);
  } while (std::next_permutation(order.begin(), order.end()));
}

void add_box(CellSoup& soup, const CellBeam& beam, Index i, Index j, Index k, const Corner& p) {
  const auto turns = [&](Index a, Index b) { return beam.alternates && (a + b) % 2 != 0; };
  switch (beam.cut) {
    case BoxCut::prisms_across:
      return add_two_prisms(
          soup, [&](int a, int b, int s) { return p(a, s, b); }, turns(i, k));
    case BoxCut::prisms_along:
      return add_two_prisms(
          soup, [&](int a, int b, int s) { return p(s, a, b); }, turns(j, k));
    case BoxCut::prisms_within:
    case BoxCut::polyhedra_of_prisms: return add_two_prisms(soup, p, turns(i, j));
    case BoxCut::six_tetrahedra:
    case BoxCut::polyhedra: return add_six_tetrahedra(soup, p);
  }
}

}  // namespace

Mesh make_cell_beam(const CellBeam& beam) {
  CellSoup soup;
  soup.region_names = {"body"};
  const auto [nx, ny, nz] = beam.boxes;
  const auto level = [&](Index i, Index j) {
    return beam.levels.empty() ? moved(j, beam.boxes[1], beam.noise, 37 * i + 71 * j + 5)
                               : beam.levels[static_cast<std::size_t>(j)];
  };
  for (Index k = 0; k <= nz; ++k)
    for (Index j = 0; j <= ny; ++j)
      for (Index i = 0; i <= nx; ++i)
        soup.points.push_back(beam.size.cwiseProduct(Vector(moved(i, nx, beam.noise, 131 * i + 17 * j), level(i, j),
                                                            static_cast<double>(k) / static_cast<double>(nz))));
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i)
        add_box(soup, beam, i, j, k,
                [&](int a, int b, int c) { return ((k + c) * (ny + 1) + j + b) * (nx + 1) + i + a; });
  Mesh mesh = assemble_mesh(std::move(soup), box_patches(Vector::Zero(), beam.size));
  const bool is_dual = beam.cut == BoxCut::polyhedra || beam.cut == BoxCut::polyhedra_of_prisms;
  return is_dual ? barycentric_dual(mesh) : mesh;
}

}  // namespace pfdm::verification
