#include "mesh/surfaces/triangle_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "physics/error.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

constexpr std::array<Triangle, 20> icosahedron_sides{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

std::array<Vector, 12> icosahedron_corners() {
  const double g = std::numbers::phi;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}}};
}

// A lattice point by its corners and their weights: the same from every side that it lies on.
using LatticeKey = std::array<std::pair<Index, Index>, 3>;

class Subdivision {
 public:
  explicit Subdivision(Index n) : n_(n), corners_(icosahedron_corners()) {}

  Index point(const Triangle& side, Index i, Index j) {
    LatticeKey key{{{side[0], n_ - i - j}, {side[1], i}, {side[2], j}}};
    for (auto& [corner, weight] : key)
      if (weight == 0) corner = -1;
    std::ranges::sort(key);
    const auto [entry, is_new] = ids_.try_emplace(key, count_of(surface_.points));
    if (is_new) surface_.points.push_back(position(key));
    return entry->second;
  }

  void add_side(const Triangle& side) {
    for (Index i = 0; i < n_; ++i)
      for (Index j = 0; i + j < n_; ++j) {
        surface_.triangles.push_back({point(side, i, j), point(side, i + 1, j), point(side, i, j + 1)});
        if (i + j + 2 <= n_)
          surface_.triangles.push_back({point(side, i + 1, j), point(side, i + 1, j + 1), point(side, i, j + 1)});
      }
  }

  TriangleSurface take() { return std::move(surface_); }

 private:
  Vector position(const LatticeKey& key) const {
    Vector sum = Vector::Zero();
    for (const auto& [corner, weight] : key)
      if (corner >= 0) sum += weight * corners_[corner];
    return sum.normalized();
  }

  Index n_;
  std::array<Vector, 12> corners_;
  std::map<LatticeKey, Index> ids_;
  TriangleSurface surface_;
};

// (4/sqrt 3) (4 pi/20): squared side of a triangle of a twentieth of the unit sphere's area.
const double unit_size = std::sqrt(4.0 / std::numbers::sqrt3 * std::numbers::pi / 5.0);

}  // namespace

void require_few_triangles(std::string_view surface, double area, double edge) {
  constexpr double most = 1e7;
  const double n = 4.0 / std::numbers::sqrt3 * area / (edge * edge);
  if (!(n < most))
    throw InputError(fmt::format("the surface of {} would get {:.2g} triangles of {}; at most {:.2g}", surface, n,
                                 quantity_text(edge, "m", 3), most));
}

TriangleSurface unit_icosphere(Index n) {
  if (n < 1) throw InputError(fmt::format("the subdivision of a sphere's surface is {}; it must be at least 1", n));
  require_few_triangles("a sphere of radius 1", 4.0 * std::numbers::pi, icosphere_size(n, 1.0));
  Subdivision subdivision(n);
  for (const Triangle& side : icosahedron_sides) subdivision.add_side(side);
  return subdivision.take();
}

double icosphere_size(Index n, double radius) { return unit_size * radius / n; }

Index icosphere_subdivision(double size, double radius) {
  return std::max(Index{1}, static_cast<Index>(std::lround(std::min(unit_size * radius / size, 1e6))));
}

}  // namespace pfdm
