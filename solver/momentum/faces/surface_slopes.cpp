#include "solver/momentum/faces/surface_slopes.h"

#include "physics/pseudo_inverse.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

SurfaceSlopes::SurfaceSlopes(const Mesh& mesh, const Patch& patch) : mesh_(mesh), faces_of_point_(mesh.points.size()) {
  for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
    for (const Index p : mesh.points_of_face(f)) faces_of_point_[p].push_back(f);
}

std::vector<Index> SurfaceSlopes::around(Index face) const {
  std::vector<Index> all;
  for (const Index p : mesh_.points_of_face(face))
    for (const Index f : faces_of_point_[p])
      if (f != face) all.push_back(f);
  std::ranges::sort(all);
  const auto rest = std::ranges::unique(all);
  all.erase(rest.begin(), rest.end());
  return all;
}

std::vector<SurfaceSlopes::Sample> SurfaceSlopes::at(Index face, const std::function<bool(Index face)>& counts) const {
  const Vector n = mesh_.face_area[face].normalized();
  const Tensor within = Tensor::Identity() - n * n.transpose();
  constexpr double cosine = 0.7;  // of faces beyond an edge of the patch
  std::vector<Sample> samples;
  Tensor moment = Tensor::Zero();
  for (const Index f : around(face)) {
    if (!counts(f) || std::abs(mesh_.face_area[f].normalized().dot(n)) < cosine) continue;
    const Vector d = mesh_.face_centre[f] - mesh_.face_centre[face], along = within * d;
    const double weight = 1.0 / d.squaredNorm();
    samples.push_back({.face = f, .d = d, .coefficient = weight * along});
    moment += weight * along * along.transpose();
  }
  constexpr double least = 1e-3;
  const Tensor inverse = pseudo_inverse(moment, least);
  for (Sample& of : samples) of.coefficient = inverse * of.coefficient;
  return samples;
}

}  // namespace pfdm
