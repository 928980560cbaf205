#include "mesh/surfaces/sphere_refinement.h"

#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace pfdm {
namespace {

class Bisection {
 public:
  explicit Bisection(TriangleSurface sphere) : sphere_(std::move(sphere)) {
    for (std::size_t t = 0; t < sphere_.triangles.size(); ++t) enter(t);
  }

  double longest_edge(std::size_t t) const { return std::sqrt(std::get<0>(rank(t, longest(t)))); }

  Vector middle(std::size_t t) const {
    Vector sum = Vector::Zero();
    for (const Index p : sphere_.triangles[t]) sum += sphere_.points[p];
    return sum.normalized();
  }

  // Bisects triangle t, and before it those on the way to an edge that is the longest of both its triangles.
  void bisect(std::size_t t) {
    const std::size_t first = t;
    while (true) {
      const std::size_t edge = longest(t);
      const auto [a, b] = ends(t, edge);
      const std::size_t other = triangle_of_.at({b, a});
      if (rank(other, longest(other)) != rank(t, edge)) {
        t = other;
        continue;
      }
      const Index m = add_middle(a, b);
      halve(t, edge, m);
      halve(other, longest(other), m);
      if (t == first || other == first) return;
      t = first;
    }
  }

  std::size_t size() const { return sphere_.triangles.size(); }
  TriangleSurface take() { return std::move(sphere_); }

 private:
  using Rank = std::tuple<double, Index, Index>;  // a strict order of the edges

  std::pair<Index, Index> ends(std::size_t t, std::size_t edge) const {
    const Triangle& triangle = sphere_.triangles[t];
    return {triangle[edge], triangle[(edge + 1) % 3]};
  }

  Rank rank(std::size_t t, std::size_t edge) const {
    const auto [a, b] = ends(t, edge);
    const Vector along = sphere_.points[std::max(a, b)] - sphere_.points[std::min(a, b)];
    return {along.squaredNorm(), std::min(a, b), std::max(a, b)};
  }

  std::size_t longest(std::size_t t) const {
    std::size_t edge = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (rank(t, k) > rank(t, edge)) edge = k;
    return edge;
  }

  void enter(std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) triangle_of_[ends(t, k)] = t;
  }

  Index add_middle(Index a, Index b) {
    sphere_.points.push_back((sphere_.points[a] + sphere_.points[b]).normalized());
    return static_cast<Index>(sphere_.points.size() - 1);
  }

  void halve(std::size_t t, std::size_t edge, Index m) {
    const Triangle old = sphere_.triangles[t];
    const Index a = old[edge], b = old[(edge + 1) % 3], c = old[(edge + 2) % 3];
    triangle_of_.erase({a, b});
    sphere_.triangles[t] = {a, m, c};
    sphere_.triangles.push_back({m, b, c});
    enter(t);
    enter(sphere_.triangles.size() - 1);
  }

  TriangleSurface sphere_;
  std::map<std::pair<Index, Index>, std::size_t> triangle_of_;  // on the left of an edge
};

}  // namespace

TriangleSurface refined_sphere(TriangleSurface sphere, const std::function<double(const Vector& direction)>& wanted) {
  Bisection bisection(std::move(sphere));
  for (std::size_t before = 0; before != bisection.size();) {
    before = bisection.size();
    for (std::size_t t = 0; t < bisection.size(); ++t)
      while (bisection.longest_edge(t) > wanted(bisection.middle(t))) bisection.bisect(t);
  }
  return bisection.take();
}

double enclosed_volume(const TriangleSurface& surface) {
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += surface.points[a].dot(surface.points[b].cross(surface.points[c])) / 6.0;
  return volume;
}

}  // namespace pfdm
