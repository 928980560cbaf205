#include "postproc/fields/energy_release_rate.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {
namespace {

constexpr double hardly_damaged = 0.1;  // in AT2 d is about ell/(2 pi r) at a distance r from a growing crack's tip

double disc_distance(double along, double across) { return std::hypot(along, across); }
double box_distance(double along, double across) { return std::max(std::abs(along), std::abs(across)); }

constexpr RegionShape shape_table[] = {
    {"disc", "distances are radii", disc_distance},
    {"box", "distances are half-widths of squares along and across the direction of growth", box_distance},
};

// q at a place.
double weight_at(const TipRegion& region, const Vector& tip, const Vector& x) {
  const Vector r = x - tip;
  const double distance = region.shape->distance(r.dot(region.direction), r.dot(region.front.cross(region.direction)));
  return std::clamp((region.outer - distance) / (region.outer - region.inner), 0.0, 1.0);
}

// Where it is neither 0 nor 1 on a face that is not parallel to the growth, the body ends within the ring.
bool leaves_body(const Mesh& mesh, const TipRegion& region, const FaceField<double>& q) {
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
    if (q[f] > 0.0 && q[f] < 1.0 && std::abs(mesh.face_area[f].normalized().dot(region.direction)) > 1e-6) return true;
  return false;
}

double extent_along(const Mesh& mesh, const Vector& axis) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Vector& x : mesh.points) {
    least = std::min(least, axis.dot(x));
    most = std::max(most, axis.dot(x));
  }
  return most - least;
}

}  // namespace

std::span<const RegionShape> region_shapes() { return shape_table; }

Vector crack_tip(const Mesh& mesh, const CellField<double>& damage, const TipRegion& region) {
  if (!region.follows) return region.point;
  Vector tip = region.point;
  double foremost = 0.0;
  const Vector across = region.front.cross(region.direction);
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (damage[P] < damage[N]) std::swap(P, N);
    if (damage[P] < region.tip_damage || damage[N] >= region.tip_damage) continue;
    const double part = (damage[P] - region.tip_damage) / (damage[P] - damage[N]);
    const Vector x = mesh.cell_centre[P] + part * (mesh.cell_centre[N] - mesh.cell_centre[P]);
    const double ahead = (x - region.point).dot(region.direction);
    if (ahead <= foremost || std::abs((x - region.point).dot(across)) > region.corridor) continue;
    foremost = ahead;
    tip = x;
  }
  return tip;
}

EnergyRelease energy_release_rate(const Mesh& mesh, const OutputFields& output, const TipRegion& region) {
  EnergyRelease result{.tip = crack_tip(mesh, output.damage, region)};
  FaceField<double> q(as_size(mesh.n_faces()));
  parallel_for(mesh.n_faces(), [&](Index f) { q[f] = weight_at(region, result.tip, mesh.face_centre[f]); });
  // grad q from its values on the faces (Gauss): it sums to exactly zero over the body, as a gradient does.
  CellField<double> release(as_size(mesh.n_cells()));
  parallel_for(mesh.n_cells(), [&](Index c) {
    Vector gradient = Vector::Zero();  // times the volume
    for (const Index f : mesh.faces_of_cell(c)) gradient += (mesh.owner[f] == c ? q[f] : -q[f]) * mesh.face_area[f];
    const Tensor& sigma = output.stress[c];
    const double psi = 0.5 * sigma.cwiseProduct(output.strain[c]).sum();
    release[c] = (output.gradient[c] * region.direction).dot(sigma * gradient) - psi * region.direction.dot(gradient);
  });
  const double sum = parallel_sum(mesh.n_cells(), [&](Index c) { return release[c]; });
  const double size = parallel_sum(mesh.n_cells(), [&](Index c) { return std::abs(release[c]); });
  const double damaged = parallel_sum(
      mesh.n_cells(), [&](Index c) { return output.damage[c] > hardly_damaged ? std::abs(release[c]) : 0.0; });
  result.G =
      leaves_body(mesh, region, q) ? std::numeric_limits<double>::quiet_NaN() : sum / extent_along(mesh, region.front);
  result.damaged_share = size > 0.0 ? damaged / size : 0.0;
  return result;
}

}  // namespace pfdm
