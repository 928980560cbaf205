#include "postproc/fields/energy_release_rate.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>

namespace pfdm {
namespace {

constexpr double hardly_damaged = 0.1;  // in AT2 d is about ell/(2 pi r) at a distance r from a growing crack's tip

double disc_distance(double along, double across) { return std::hypot(along, across); }
double box_distance(double along, double across) { return std::max(std::abs(along), std::abs(across)); }

constexpr RegionShape shape_table[] = {
    {"disc", "distances are radii", disc_distance},
    {"box", "distances are half-widths of squares along and across the direction of growth", box_distance},
};

// The place, of a sector turned about the axis z into the half-plane y = 0, x > 0.
Vector place_of(const TipRegion& region, const Vector& x) {
  return region.is_about_axis ? Vector(std::hypot(x.x(), x.y()), 0.0, x.z()) : x;
}

// The direction of growth at a place, which turns about the axis of a sector.
Vector growth_at(const TipRegion& region, const Vector& x) {
  if (!region.is_about_axis) return region.direction;
  const double radius = std::hypot(x.x(), x.y());
  const Vector outwards = radius > 0.0 ? Vector(x.x() / radius, x.y() / radius, 0.0) : Vector::Zero();
  return region.direction.x() * outwards + region.direction.z() * Vector::UnitZ();
}

// q at a place.
double weight_at(const TipRegion& region, const Vector& tip, const Vector& x) {
  const Vector r = place_of(region, x) - tip;
  const double distance = region.shape->distance(r.dot(region.direction), r.dot(region.front.cross(region.direction)));
  return std::clamp((region.outer - distance) / (region.outer - region.inner), 0.0, 1.0);
}

// Where it is neither 0 nor 1 on a face that is not parallel to the growth, the body ends within the ring.
bool leaves_body(const Mesh& mesh, const TipRegion& region, const FaceField<double>& q) {
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
    if (q[f] > 0.0 && q[f] < 1.0 &&
        std::abs(mesh.face_area[f].normalized().dot(growth_at(region, mesh.face_centre[f]))) > 1e-6)
      return true;
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

// Width of a sector at the radius of the tip, between the two planes that bound it.
double width_at(const Mesh& mesh, double radius) {
  Vector middle = Vector::Zero();
  for (const Vector& x : mesh.cell_centre) middle += Vector(x.x(), x.y(), 0.0).normalized();
  middle.normalize();
  double sine = 0.0;
  for (const Vector& x : mesh.points)
    if (const double r = std::hypot(x.x(), x.y()); r > 0.0)
      sine = std::max(sine, std::abs(middle.x() * x.y() - middle.y() * x.x()) / r);
  return 2.0 * radius * sine;
}

double length_of_front(const Mesh& mesh, const TipRegion& region, const Vector& tip) {
  return region.is_about_axis ? width_at(mesh, tip.x()) : extent_along(mesh, region.front);
}

// int q over the faces of a cell: its gradient times the volume. It sums to exactly zero over the body, as a gradient
// does.
Vector gradient_of(const Mesh& mesh, const FaceField<double>& q, Index c) {
  Vector gradient = Vector::Zero();
  for (const Index f : mesh.faces_of_cell(c)) gradient += q[f] * mesh.outward_area(f, c);
  return gradient;
}

// int grad theta dV over a cell: of theta = q e, with e the direction of growth, which turns about an axis.
Tensor growth_gradient(const Mesh& mesh, const TipRegion& region, const FaceField<double>& q, Index c) {
  Tensor gradient = Tensor::Zero();
  for (const Index f : mesh.faces_of_cell(c))
    gradient += q[f] * growth_at(region, mesh.face_centre[f]) * mesh.outward_area(f, c).transpose();
  return gradient;
}

FaceField<double> weights(const Mesh& mesh, const TipRegion& region, const Vector& tip) {
  FaceField<double> q(mesh.n_faces());
  parallel_for(mesh.n_faces(), [&](Index f) { q[f] = weight_at(region, tip, mesh.face_centre[f]); });
  return q;
}

// Stress that belongs to the displacement gradient, and elastic energy [J/m^3]: at finite strain per reference area and
// volume, the first Piola-Kirchhoff stress that the tractions of a cell in equilibrium have on average.
struct Elastic {
  Tensor stress = Tensor::Zero();
  double energy = 0.0;
};

Elastic elastic_in(const Mesh& mesh, const OutputFields& output, Index c) {
  if (output.deformation_gradient.size() == 0) {
    const Tensor& sigma = output.stress[c];
    return {sigma, 0.5 * sigma.cwiseProduct(output.strain[c]).sum()};
  }
  Tensor moment = Tensor::Zero(),
         closure = Tensor::Zero();  // the latter the volume's unit matrix where faces are plane
  for (const Index f : mesh.faces_of_cell(c)) {
    const Vector lever = mesh.outwards(f, c) * (mesh.face_centre[f] - mesh.cell_centre[c]);
    moment += mesh.face_area[f].norm() * output.traction[f] * lever.transpose();
    closure += mesh.face_area[f] * lever.transpose();
  }
  return {moment * closure.inverse(), output.energy_density[c]};
}

// What a cell adds to G, times the length of the front [J/m].
double release_of(const Mesh& mesh, const OutputFields& output, const TipRegion& region, const FaceField<double>& q,
                  Index c) {
  const Tensor gradient = growth_gradient(mesh, region, q, c);
  if (gradient.squaredNorm() == 0.0) return 0.0;
  const Elastic elastic = elastic_in(mesh, output, c);
  return elastic.stress.cwiseProduct(output.gradient[c] * gradient).sum() - elastic.energy * gradient.trace();
}

struct Crack {
  InterfaceCrack between;
  bool is_half = false;  // one side of it is the mirror image of the other
};

// A condition under which the body goes on as its mirror image beyond a face with this normal.
bool is_mirror(const BoundaryCondition& condition, const Vector& normal, const Vector& x) {
  if (condition.kind == BoundaryCondition::Kind::symmetry) return true;
  if (condition.kind != BoundaryCondition::Kind::components) return false;
  if (condition.pressure || (condition.value && !condition.value(x, 1.0).isZero())) return false;
  for (Index i = 0; i < 3; ++i)
    if (condition.displacement_prescribed[i] != (std::abs(normal[i]) > 0.5)) return false;
  return normal.cwiseAbs().maxCoeff() > 1.0 - 1e-9;
}

// Whether the crack's plane ahead of the tip is one of symmetry, as far as the ring reaches.
bool is_mirrored(const Mesh& mesh, const FractureModel& model, const TipRegion& region, const FaceField<double>& q,
                 const Vector& tip) {
  const Vector across = region.front.cross(region.direction);
  bool any = false;
  for (const Patch& patch : mesh.patches) {
    const auto on = std::ranges::find(model.boundary, patch.name, &BoundaryCondition::patch);
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Vector r = mesh.face_centre[f] - tip, n = mesh.face_area[f].normalized();
      const bool is_ahead = r.dot(region.direction) > 0.0 && std::abs(r.dot(across)) < 1e-6 * region.outer;
      if (q[f] == 0.0 || !is_ahead || std::abs(n.dot(across)) < 0.5) continue;
      if (on == model.boundary.end() || !is_mirror(*on, n, mesh.face_centre[f])) return false;
      any = true;
    }
  }
  return any;
}

// The elasticities of the ring's cells above and below the crack; or why there are none.
std::variant<Crack, std::string_view> crack_between(const Mesh& mesh, const FractureModel& model,
                                                    const TipRegion& region, const FaceField<double>& q,
                                                    const CellField<Vector>& gradient, const Vector& tip) {
  if (model.is_finite_strain()) return "they are those of small strain";
  std::optional<IsotropicElasticity> upper, lower;
  const Vector across = region.front.cross(region.direction);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (gradient[c].squaredNorm() == 0.0) continue;
    std::optional<IsotropicElasticity>& side = (mesh.cell_centre[c] - tip).dot(across) >= 0.0 ? upper : lower;
    if (model.in_cell(mesh, c).material)
      return "they are those of linear elasticity, and a material of the ring is not";
    const IsotropicElasticity& elasticity = model.in_cell(mesh, c).elasticity;
    if (side && !(*side == elasticity)) return "the part of the ring on one side of the crack has two elasticities";
    side = elasticity;
  }
  const bool is_half = !upper || !lower;
  if (is_half && !is_mirrored(mesh, model, region, q, tip))
    return "the ring lies on one side of the crack, whose plane is not one of symmetry ahead of the tip";
  const IsotropicElasticity& one = upper ? *upper : *lower;
  return Crack{{.upper = one, .lower = lower.value_or(one), .reference_length = region.reference_length}, is_half};
}

// The mixed part of G of the body's field and the near field with K, times the extent along the front [J/m].
double interaction(const Mesh& mesh, const OutputFields& output, const TipRegion& region, const InterfaceCrack& crack,
                   const CellField<Vector>& gradient, const Vector& tip, std::complex<double> K) {
  Tensor axes;  // rows: along, across, front
  axes << region.direction.transpose(), region.front.cross(region.direction).transpose(), region.front.transpose();
  return parallel_sum(mesh.n_cells(), [&](Index c) {
    if (gradient[c].squaredNorm() == 0.0) return 0.0;
    const Vector r = axes * (mesh.cell_centre[c] - tip), q = axes * gradient[c];
    const Tensor sigma = axes * output.stress[c] * axes.transpose(), eps = axes * output.strain[c] * axes.transpose();
    const Vector slope = axes * (output.gradient[c] * region.direction);
    const NearField near = near_field(crack, r.x(), r.y(), K);
    const Vector near_slope(near.slope.real(), near.slope.imag(), 0.0);
    Tensor near_sigma = Tensor::Zero();
    near_sigma.topLeftCorner<2, 2>() << near.s_xx, near.s_xy, near.s_xy, near.s_yy;
    return slope.dot(near_sigma * q) + near_slope.dot(sigma * q) - near_sigma.cwiseProduct(eps).sum() * q.x();
  });
}

}  // namespace

std::span<const RegionShape> region_shapes() { return shape_table; }

void require_ring(const Mesh& mesh, const TipRegion& region) {
  const FaceField<double> q = weights(mesh, region, region.point);
  for (Index f = 0; f < mesh.n_faces(); ++f)
    if (q[f] > 0.0 && q[f] < 1.0) return;
  throw InputError(
      fmt::format("[output.energy_release_rate] region \"{}\": no face of the mesh has its centre in the ring between "
                  "inner and outer; move or widen it",
                  region.name));
}

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
    const Vector x = place_of(region, mesh.cell_centre[P] + part * (mesh.cell_centre[N] - mesh.cell_centre[P]));
    const double ahead = (x - region.point).dot(region.direction);
    if (ahead <= foremost || std::abs((x - region.point).dot(across)) > region.corridor) continue;
    foremost = ahead;
    tip = x;
  }
  return tip;
}

EnergyRelease energy_release_rate(const Mesh& mesh, const OutputFields& output, const TipRegion& region) {
  EnergyRelease result{.tip = crack_tip(mesh, output.damage, region)};
  const FaceField<double> q = weights(mesh, region, result.tip);
  CellField<double> release(mesh.n_cells(), 0.0);
  parallel_for(mesh.n_cells(), [&](Index c) { release[c] = release_of(mesh, output, region, q, c); });
  const double sum = parallel_sum(mesh.n_cells(), [&](Index c) { return release[c]; });
  const double size = parallel_sum(mesh.n_cells(), [&](Index c) { return std::abs(release[c]); });
  const double damaged = parallel_sum(
      mesh.n_cells(), [&](Index c) { return output.damage[c] > hardly_damaged ? std::abs(release[c]) : 0.0; });
  result.G = leaves_body(mesh, region, q) ? std::numeric_limits<double>::quiet_NaN()
                                          : sum / length_of_front(mesh, region, result.tip);
  result.damaged_share = size > 0.0 ? damaged / size : 0.0;
  return result;
}

StressIntensity stress_intensity(const Mesh& mesh, const FractureModel& model, const OutputFields& output,
                                 const TipRegion& region) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const EnergyRelease release = energy_release_rate(mesh, output, region);
  if (std::isnan(release.G)) return {none, none, none, ""};
  const FaceField<double> q = weights(mesh, region, release.tip);
  CellField<Vector> gradient(mesh.n_cells());
  parallel_for(mesh.n_cells(), [&](Index c) { gradient[c] = gradient_of(mesh, q, c); });
  std::variant<Crack, std::string_view> found = crack_between(mesh, model, region, q, gradient, release.tip);
  if (const auto* why = std::get_if<std::string_view>(&found)) return {none, none, none, *why};
  Crack& crack = std::get<Crack>(found);
  crack.between.plane_stress = output.plane_stress_normal.squaredNorm() > 0.0;
  const double K1 = interaction(mesh, output, region, crack.between, gradient, release.tip, {1.0, 0.0});
  const double K2 = interaction(mesh, output, region, crack.between, gradient, release.tip, {0.0, 1.0});
  const double G = std::max(release.G, 0.0) * (crack.is_half ? 2.0 : 1.0);
  const double size = std::sqrt(crack.between.modulus() * G);
  const double angle = crack.is_half ? (K1 < 0.0 ? std::numbers::pi : 0.0) : std::atan2(K2, K1);
  return {size * std::cos(angle), crack.is_half ? 0.0 : size * std::sin(angle), angle, ""};
}

}  // namespace pfdm
