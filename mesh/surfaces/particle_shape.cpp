#include "mesh/surfaces/particle_shape.h"
#include "physics/portable_math.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr double flat = 1e-3;      // least eigenvalue of the normals' second moment, over its trace, that is no plane
constexpr std::size_t tries = 64;  // triangles from which a point inside is looked for

struct Corners {
  Vector a, b, c;
  Vector area() const { return 0.5 * (b - a).cross(c - a); }
  Vector middle() const { return (a + b + c) / 3.0; }
};

Corners corners_of(const TriangleSurface& surface, const Triangle& t) {
  return {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
}

// Moeller, Trumbore, J. Graphics Tools 2 (1997) 21; infinity where the line misses the triangle.
double distance_along(const Vector& from, const Vector& direction, const Corners& t) {
  constexpr double miss = std::numeric_limits<double>::infinity();
  const Vector ab = t.b - t.a, ac = t.c - t.a, p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (std::abs(determinant) < 1e-12 * ab.norm() * ac.norm()) return miss;
  const Vector r = from - t.a;
  const double u = r.dot(p) / determinant;
  const Vector q = r.cross(ab);
  const double v = direction.dot(q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return miss;
  return ac.dot(q) / determinant;
}

// n . m = 1 for the normals around a point, the part along which they do not differ by their mean.
Vector offset_from(const Tensor& moment, const Vector& sum) {
  const Vector mean = sum.normalized();
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(moment);
  Vector offset = mean;
  for (int k = 0; k < 3; ++k) {
    const Vector axis = eigen.eigenvectors().col(k);
    if (eigen.eigenvalues()[k] > flat * moment.trace())
      offset += (axis.dot(sum - moment * mean) / eigen.eigenvalues()[k]) * axis;
  }
  return offset;
}

double angle_at(const Vector& x, const Vector& y, const Vector& z) {
  return portable::atan2((y - x).cross(z - x).norm(), (y - x).dot(z - x));
}

}  // namespace

Vector centroid(const TriangleSurface& surface) {
  const Vector origin = surface.points.front();
  Vector moment = Vector::Zero();
  double volume = 0.0;
  for (const Triangle& triangle : surface.triangles) {
    const auto [a, b, c] = corners_of(surface, triangle);
    const double part = (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
    volume += part;
    moment += part * 0.25 * (a + b + c - 3.0 * origin);
  }
  return origin + moment / volume;
}

TriangleSurface about_centroid(TriangleSurface surface, double scale, const Tensor& rotation) {
  const Vector middle = centroid(surface);
  for (Vector& x : surface.points) x = rotation * (scale * (x - middle));
  return surface;
}

std::vector<Vector> offset_directions(const TriangleSurface& surface) {
  std::vector<Tensor> moment(surface.points.size(), Tensor::Zero());
  std::vector<Vector> sum(surface.points.size(), Vector::Zero());
  for (const Triangle& t : surface.triangles) {
    const Vector normal = corners_of(surface, t).area().normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = [&](std::size_t j) -> const Vector& { return surface.points[t[j % 3]]; };
      const double weight = angle_at(at(i), at(i + 1), at(i + 2));
      moment[t[i]] += weight * normal * normal.transpose();
      sum[t[i]] += weight * normal;
    }
  }
  std::vector<Vector> offsets;
  for (std::size_t p = 0; p < surface.points.size(); ++p) offsets.push_back(offset_from(moment[p], sum[p]));
  return offsets;
}

Vector point_inside(const TriangleSurface& surface) {
  Vector best = centroid(surface);
  double deepest = 0.0;
  const std::size_t stride = std::max<std::size_t>(1, surface.triangles.size() / tries);
  for (std::size_t i = 0; i < surface.triangles.size(); i += stride) {
    const Corners start = corners_of(surface, surface.triangles[i]);
    const Vector inwards = -start.area().normalized();
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < surface.triangles.size(); ++j) {
      if (j == i) continue;
      const double distance = distance_along(start.middle(), inwards, corners_of(surface, surface.triangles[j]));
      if (distance > 0.0) depth = std::min(depth, distance);
    }
    if (!std::isfinite(depth) || depth <= deepest) continue;
    deepest = depth;
    best = start.middle() + 0.5 * depth * inwards;
  }
  return best;
}

bool encloses(const TriangleSurface& surface, const Vector& x) {
  double angle = 0.0;
  for (const Triangle& triangle : surface.triangles) {
    Corners t = corners_of(surface, triangle);
    t = {t.a - x, t.b - x, t.c - x};
    const double a = t.a.norm(), b = t.b.norm(), c = t.c.norm();
    angle += 2.0 * portable::atan2(t.a.dot(t.b.cross(t.c)),
                                   a * b * c + t.a.dot(t.b) * c + t.b.dot(t.c) * a + t.c.dot(t.a) * b);
  }
  return angle > 2.0 * std::numbers::pi;
}

}  // namespace pfdm
