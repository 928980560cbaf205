#include "mesh/generators/packed_spheres.h"

#include "mesh/packing/convex_distance.h"
#include "mesh/packing/shape_packing.h"
#include "mesh/surfaces/particle_shape.h"
#include "mesh/surfaces/sphere_refinement.h"
#include "mesh/surfaces/surface_remeshing.h"
#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace pfdm {
namespace {

constexpr std::size_t most_spheres = 5000;
constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15;  // diameters and places are drawn independently

double ball_volume(double diameter) { return std::numbers::pi / 6.0 * diameter * diameter * diameter; }

double draw(const DiameterDistribution& d, std::size_t number, RandomNumbers& random) {
  using Kind = DiameterDistribution::Kind;
  if (d.kind == Kind::constant) return d.mean;
  if (d.kind == Kind::uniform) return d.least + (d.most - d.least) * random.uniform();
  if (d.kind == Kind::list) return d.values[number % d.values.size()];
  const double variance = portable::log1p(d.coefficient * d.coefficient),
               median = portable::log(d.mean) - 0.5 * variance;
  for (int trial = 0; trial < 10000; ++trial) {
    const double diameter = portable::exp(median + std::sqrt(variance) * random.normal());
    if (diameter >= d.least && (d.most == 0.0 || diameter <= d.most)) return diameter;
  }
  throw InputError(
      fmt::format("hardly any diameter of the lognormal distribution (mean {}, coefficient {:.4g}) lies between {}",
                  quantity_text(d.mean, "m"), d.coefficient, quantities_text({d.least, d.most}, "m", " and ")));
}

// Radius of the polyhedron's corners over that of the sphere of its volume.
double corner_factor(const TriangleSurface& unit) {
  return portable::cbrt(4.0 / 3.0 * std::numbers::pi / enclosed_volume(unit));
}

Index subdivision_of(const Particle& like, double radius) {
  return like.subdivision > 0 ? like.subdivision : icosphere_subdivision(like.surface_size, radius);
}

double thickness_of_layers(const Particle& like) { return like.n_layers > 0 ? like.layer_thickness : 0.0; }

TriangleSurface turned(TriangleSurface sphere, const Tensor& rotation) {
  for (Vector& x : sphere.points) x = rotation * x;
  return sphere;
}

// Distance from x on a particle to the nearest other one, or to a side of the box.
double distance_to_others(const Vector& x, std::size_t i, const ParticlesInBoxSettings& box) {
  double nearest = std::min((x - box.lower).minCoeff(), (box.upper - x).minCoeff());
  for (std::size_t j = 0; j < box.particles.size(); ++j)
    if (const Particle& other = box.particles[j]; j != i)
      nearest = std::min(nearest, (x - other.centre).norm() - other.radius - thickness_of_layers(other));
  return nearest;
}

TriangleSurface refined(const PackedSpheresSettings& settings, std::size_t i, const ParticlesInBoxSettings& box) {
  const Particle& particle = box.particles[i];
  // Edges of an icosphere differ: the longest ones are taken as they are.
  const double size = icosphere_size(particle.subdivision, 1.0), usual = 1.3 * size;
  const double outer = particle.radius + thickness_of_layers(particle);
  const auto wanted = [&](const Vector& direction) {
    const double gap = distance_to_others(particle.centre + outer * direction, i, box) / particle.radius;
    return std::clamp(settings.edges_over_gap * gap, settings.smallest_surface_size * usual, usual);
  };
  return settings.edges_over_gap > 0.0 ? refined_sphere(particle.directions, wanted) : particle.directions;
}

Particle make_particle(const PackedSpheresSettings& settings, std::size_t i, RandomNumbers& random) {
  Particle particle = settings.like;
  const double radius = 0.5 * settings.diameters[i];
  particle.subdivision = subdivision_of(settings.like, radius);
  particle.surface_size = 0.0;
  particle.directions = turned(unit_icosphere(particle.subdivision), random.rotation());
  particle.radius = radius * corner_factor(particle.directions);
  if (settings.numbered) particle.region = numbered_region(settings.like.region, i);
  return particle;
}

void check_gaps(const PackedSpheresSettings& settings, const ParticlesInBoxSettings& box) {
  if (settings.diameters.empty()) throw InputError("there are no spheres: give their diameters");
  if (settings.gap < 0.0 || settings.wall_gap < 0.0) throw InputError("a gap between spheres is negative");
  if (!settings.centres.empty() && settings.centres.size() != settings.diameters.size())
    throw InputError(fmt::format("there are {} centres and {} diameters of spheres", settings.centres.size(),
                                 settings.diameters.size()));
  for (const double diameter : settings.diameters)
    if (!(diameter > 0.0))
      throw InputError(fmt::format("a sphere has the diameter {}", quantity_text(diameter, "m", 6)));
  if (!((box.upper - box.lower).minCoeff() > 0.0)) throw InputError("a side of the box is not positive");
}

SpherePacking packing_of(const PackedSpheresSettings& settings, const ParticlesInBoxSettings& box) {
  SpherePacking packing{
      .lower = box.lower, .upper = box.upper, .radii = {}, .gap = settings.gap, .wall_gap = settings.wall_gap};
  for (const Particle& particle : box.particles)
    packing.radii.push_back(particle.radius + thickness_of_layers(particle));
  return packing;
}

// The k-th shape with this volume, remeshed, about its centroid: what new triangles take of it is given back.
TriangleSurface shape_of(const PackedSpheresSettings& settings, std::size_t k, double volume) {
  const PackedShape& shape = settings.shapes[k];
  const double scale = portable::cbrt(volume / enclosed_volume(shape.given.surface));
  const TriangleSurface body = about_centroid(shape.given.surface, scale, Tensor::Identity());
  const TriangleSurface fine = remeshed_body({shape.given.name, body}, settings.like.surface_size, shape.sharp);
  return about_centroid(fine, portable::cbrt(volume / enclosed_volume(fine)), Tensor::Identity());
}

std::vector<Vector> corners_with_layers(const Particle& particle) {
  std::vector<Vector> points = particle.shape.points;
  if (particle.n_layers > 0) {
    const std::vector<Vector> outwards = offset_directions(particle.shape);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] += particle.layer_thickness * outwards[i];
  }
  return hull_corners(points);
}

void add_shapes(const PackedSpheresSettings& settings, ParticlesInBoxSettings& box, RandomNumbers& random) {
  ShapePacking packing{
      .lower = box.lower, .upper = box.upper, .bodies = {}, .gap = settings.gap, .wall_gap = settings.wall_gap};
  for (std::size_t i = 0; i < settings.diameters.size(); ++i) {
    const std::size_t n = settings.shapes.size();
    Particle particle = settings.like;
    const bool known = i >= n && settings.diameters[i] == settings.diameters[i - n];
    particle.shape = known ? box.particles[i - n].shape : shape_of(settings, i % n, ball_volume(settings.diameters[i]));
    if (settings.numbered) particle.region = numbered_region(settings.like.region, i);
    packing.bodies.push_back(known ? packing.bodies[i - n] : corners_with_layers(particle));
    box.particles.push_back(std::move(particle));
  }
  const std::vector<ShapePlace> places = pack_shapes(packing, random);
  for (std::size_t i = 0; i < places.size(); ++i) {
    box.particles[i].shape = turned(std::move(box.particles[i].shape), places[i].rotation);
    box.particles[i].centre = places[i].centre;
  }
}

}  // namespace

std::string numbered_region(const std::string& region, std::size_t i) { return fmt::format("{}_{}", region, i + 1); }

ParticlesInBoxSettings packed_particles(const PackedSpheresSettings& settings) {
  ParticlesInBoxSettings box = settings.box;
  check_gaps(settings, box);
  RandomNumbers random(settings.seed);
  if (!settings.shapes.empty()) {
    add_shapes(settings, box, random);
    return box;
  }
  for (std::size_t i = 0; i < settings.diameters.size(); ++i)
    box.particles.push_back(make_particle(settings, i, random));
  const std::vector<Vector> centres =
      settings.centres.empty() ? pack_spheres(packing_of(settings, box), random) : settings.centres;
  for (std::size_t i = 0; i < centres.size(); ++i) box.particles[i].centre = centres[i];
  for (std::size_t i = 0; i < centres.size(); ++i) {
    Particle& particle = box.particles[i];
    particle.directions = refined(settings, i, box);
    particle.radius = 0.5 * settings.diameters[i] * corner_factor(particle.directions);
  }
  return box;
}

Mesh make_packed_spheres(const PackedSpheresSettings& settings) {
  return make_particles_in_box(packed_particles(settings));
}

std::vector<double> draw_diameters(const DiameterDistribution& distribution, Index count, double volume, bool ratios,
                                   std::uint64_t seed) {
  RandomNumbers random(seed ^ other_stream);
  std::vector<double> diameters;
  double sum = 0.0;
  while (count > 0 ? diameters.size() < as_size(count) : sum < volume) {
    diameters.push_back(draw(distribution, diameters.size(), random));
    sum += ball_volume(diameters.back());
    if (diameters.size() > most_spheres)
      throw InputError(
          fmt::format("more than {} spheres are needed; take larger ones, or a smaller box", most_spheres));
  }
  if (count == 0 && diameters.size() > 1 && sum - volume > 0.5 * ball_volume(diameters.back())) {
    sum -= ball_volume(diameters.back());
    diameters.pop_back();
  }
  if (volume == 0.0 || diameters.empty()) return diameters;
  const double factor = portable::cbrt(volume / sum);
  if (!ratios && std::abs(factor - 1.0) > 0.1)
    throw InputError(
        fmt::format("no whole number of such spheres has the volume fraction wanted: {} of them would have "
                    "to be {:.3g} times as large; give their count, or a larger box",
                    diameters.size(), factor));
  for (double& diameter : diameters) diameter *= factor;
  return diameters;
}

}  // namespace pfdm
