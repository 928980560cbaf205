#include "mesh/packing/convex_distance.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace pfdm {
namespace {

// Up to four points whose hull is a simplex.
struct Simplex {
  std::array<Vector, 4> points;
  int n = 0;
};

// The point of the affine hull of some of the points that is nearest to the origin; nothing if it is not within them.
struct Nearest {
  Vector point = Vector::Zero();
  bool is_within = false;
};

Nearest nearest_of(const std::array<Vector, 4>& points, const std::array<int, 4>& chosen, int n) {
  const Vector& first = points[chosen[0]];
  if (n == 1) return {first, true};
  Tensor edges = Tensor::Zero();  // of the columns that stay zero the share is zero too
  for (int k = 1; k < n; ++k) edges.col(k - 1) = points[chosen[k]] - first;
  const Vector share = edges.colPivHouseholderQr().solve(-first);
  if (share.minCoeff() < 0.0 || share.sum() > 1.0) return {};
  return {first + edges * share, true};
}

// The point of the simplex that is nearest to the origin; the simplex keeps the points that hold it.
Vector reduce(Simplex& simplex) {
  Vector best = Vector::Zero();
  double least = std::numeric_limits<double>::infinity();
  std::array<int, 4> kept{};
  int n_kept = 0;
  for (unsigned set = 1; set < 1U << static_cast<unsigned>(simplex.n); ++set) {
    std::array<int, 4> chosen{};
    int n = 0;
    for (int k = 0; k < simplex.n; ++k)
      if ((set >> static_cast<unsigned>(k) & 1U) != 0U) chosen[n++] = k;
    const Nearest nearest = nearest_of(simplex.points, chosen, n);
    if (!nearest.is_within || !(nearest.point.squaredNorm() < least)) continue;
    least = nearest.point.squaredNorm();
    best = nearest.point;
    kept = chosen;
    n_kept = n;
  }
  std::array<Vector, 4> points;
  for (int k = 0; k < n_kept; ++k) points[k] = simplex.points[kept[k]];
  simplex = {points, n_kept};
  return best;
}

}  // namespace

std::vector<Vector> hull_corners(const std::vector<Vector>& points) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> given;
  given.reserve(points.size());
  for (const Vector& x : points) given.emplace_back(x[0], x[1], x[2]);
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(given.begin(), given.end(), hull);
  std::set<std::array<double, 3>> on_hull;
  for (const auto v : hull.vertices()) on_hull.insert({hull.point(v).x(), hull.point(v).y(), hull.point(v).z()});
  std::vector<Vector> corners;
  for (const Vector& x : points)
    if (on_hull.erase({x[0], x[1], x[2]}) > 0) corners.push_back(x);
  return corners;
}

Vector PlacedHull::farthest(const Vector& direction) const {
  const Vector own = rotation.transpose() * direction;
  const Vector& corner = *std::ranges::max_element(*corners, {}, [&](const Vector& x) { return own.dot(x); });
  return centre + scale * (rotation * corner);
}

bool are_apart(const PlacedHull& a, const PlacedHull& b, double distance) {
  constexpr int most = 60;
  constexpr double rounding = 1e-10;
  Simplex simplex;
  Vector nearest = a.centre - b.centre;  // a point of the difference if both hold their centres
  for (int k = 0; k < most; ++k) {
    const double length = nearest.norm();
    if (k > 0 && length < distance) return false;
    const Vector support = a.farthest(-nearest) - b.farthest(nearest);
    const double gap = nearest.dot(support);  // the whole difference lies beyond this plane
    if (gap > 0.0 && gap >= distance * length) return true;
    // No nearer point: the distance is the length, which is not less than it has to be.
    if (k > 0 && length * length - gap <= rounding * length * length) return true;
    simplex.points[simplex.n++] = support;
    nearest = reduce(simplex);
    if (simplex.n == 4 || nearest.squaredNorm() <= rounding * rounding * support.squaredNorm()) return false;
  }
  return false;  // not decided: as if they touched
}

}  // namespace pfdm
