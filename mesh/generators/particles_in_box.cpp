#include "mesh/generators/particles_in_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "mesh/generators/expected_cells.h"
#include "mesh/generators/particles_in_box_checks.h"
#include "mesh/generators/tetgen_wrapper.h"
#include "mesh/patch_rules.h"
#include "mesh/surfaces/box_surface.h"
#include "mesh/surfaces/particle_shape.h"
#include "mesh/surfaces/surface_checks.h"
#include "physics/error.h"
#include "physics/portable_math.h"

namespace pfdm {
namespace {

Index subdivision_of(const Particle& p) {
  return p.subdivision > 0 ? p.subdivision : icosphere_subdivision(p.surface_size, p.radius);
}

TriangleSurface unit_surface(const Particle& p) {
  if (!p.directions.triangles.empty()) return p.directions;
  TriangleSurface sphere = unit_icosphere(subdivision_of(p));
  const double c = portable::cos(p.angle), s = portable::sin(p.angle);
  for (Vector& x : sphere.points) x = Vector(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]);
  return sphere;
}

// A particle's surface, and the same moved outwards.
class ParticleBody {
 public:
  explicit ParticleBody(const Particle& particle)
      : particle_(&particle), surface_(is_sphere(particle) ? unit_surface(particle) : particle.shape) {
    if (!is_sphere(particle)) offsets_ = offset_directions(surface_);
  }

  const std::vector<Triangle>& triangles() const { return surface_.triangles; }
  std::size_t n_points() const { return surface_.points.size(); }
  Vector point(std::size_t i, double outwards) const {
    const Vector& x = surface_.points[i];
    if (is_sphere(*particle_)) return particle_->centre + (particle_->radius + outwards) * x;
    return particle_->centre + (x + outwards * offsets_[i]);
  }
  TriangleSurface surface(double outwards) const {
    TriangleSurface moved = surface_;
    for (std::size_t i = 0; i < n_points(); ++i) moved.points[i] = point(i, outwards);
    return moved;
  }
  Vector inside() const {
    return is_sphere(*particle_) ? particle_->centre : Vector(particle_->centre + point_inside(surface_));
  }

 private:
  const Particle* particle_;
  TriangleSurface surface_;        // directions of a sphere's points, or points about the centre
  std::vector<Vector> offsets_{};  // of a body that is no sphere
};

SizeSource size_source(const Particle& p) {
  std::vector<Vector> points = ParticleBody(p).surface(layers_thickness(p)).points;
  double radius = 0.0;
  for (const Vector& x : points) radius = std::max(radius, (x - p.centre).norm());
  return {p.centre, radius, p.surface_size, 0.0, p.surface_size, p.surface_size, std::move(points)};
}

SizeField size_field(const ParticlesInBoxSettings& settings) {
  std::vector<SizeSource> sources;
  for (const Particle& p : settings.particles) {
    if (!is_sphere(p)) {
      sources.push_back(size_source(p));
      continue;
    }
    const Index n = subdivision_of(p);
    const double core_size = icosphere_size(n, p.radius);
    sources.push_back({p.centre, outer_radius(p), icosphere_size(n, outer_radius(p)), p.radius, core_size,
                       settings.particle_size_factor * core_size});
  }
  return {std::move(sources), settings.grading, settings.size_far};
}

class Builder {
 public:
  explicit Builder(const ParticlesInBoxSettings& settings) : settings_(settings), size_(size_field(settings)) {
    for (const Particle& particle : settings.particles) bodies_.emplace_back(particle);
  }

  Mesh build() {
    require_memory_for(expected_tetrahedra(size_, settings_.lower, settings_.upper), "the box");
    for (std::size_t i = 0; i < settings_.particles.size(); ++i) add_particle_surfaces(i);
    add_surface("the box", box_surface(box_nodes()));
    check_surfaces(surfaces_);
    check_shapes();
    add_matrix_seed();
    fill_with_tetrahedra();
    for (std::size_t i = 0; i < settings_.particles.size(); ++i) add_layers(i);
    return assemble_mesh(std::move(soup_), box_patches(settings_.lower, settings_.upper));
  }

 private:
  BoxNodes box_nodes() const {
    if (settings_.boundary_size > 0.0)
      return uniform_box_nodes(settings_.lower, settings_.upper, settings_.boundary_size);
    return graded_box_nodes(settings_.lower, settings_.upper, size_);
  }

  Index region(const std::string& name) {
    const auto found = std::ranges::find(soup_.region_names, name);
    if (found != soup_.region_names.end()) return static_cast<Index>(found - soup_.region_names.begin());
    soup_.region_names.push_back(name);
    return static_cast<Index>(soup_.region_names.size() - 1);
  }

  Index add_surface(const std::string& name, const TriangleSurface& surface) {
    TriangleSurface& all = input_.surfaces;
    const auto first = count_of(all.points);
    all.points.insert(all.points.end(), surface.points.begin(), surface.points.end());
    for (const Triangle& t : surface.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    surfaces_.push_back({name, surface});
    return first;
  }

  void add_particle_surfaces(std::size_t i) {
    const Particle& p = settings_.particles[i];
    const ParticleBody& body = bodies_[i];
    std::vector<Index> first;
    const std::string name = describe_particle(settings_, i);
    first.push_back(add_surface(name, body.surface(0.0)));
    input_.seeds.push_back({body.inside(), region(p.region)});
    if (p.n_layers > 0) {
      first.resize(p.n_layers + 1);
      first.back() = add_surface("the layers of " + name, body.surface(p.layer_thickness));
      input_.holes.push_back(body.point(0, 0.5 * p.layer_thickness));
    }
    first_.push_back(std::move(first));
  }

  // What surfaces that do not intersect may still be: outside the box, or one in the other.
  void check_shapes() const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Vector x = bodies_[i].point(0, layers_thickness(settings_.particles[i]));
      if (!((x - settings_.lower).minCoeff() > 0.0) || !((settings_.upper - x).minCoeff() > 0.0))
        throw InputError(fmt::format("{} leaves the box", describe_particle(settings_, i)));
      for (std::size_t j = 0; j < bodies_.size(); ++j)
        if (const Particle& other = settings_.particles[j]; i != j &&
                                                            !(is_sphere(settings_.particles[i]) && is_sphere(other)) &&
                                                            encloses(bodies_[j].surface(layers_thickness(other)), x))
          throw InputError(
              fmt::format("{} lies within {}", describe_particle(settings_, i), describe_particle(settings_, j)));
    }
  }

  // Near a corner of the box, which no ball inside the box can reach.
  void add_matrix_seed() {
    double step = 0.01 * (settings_.upper - settings_.lower).minCoeff();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      step = std::min(step, is_sphere(settings_.particles[i]) ? 0.1 * settings_.particles[i].radius : 0.5 * room(i));
    input_.seeds.push_back({settings_.lower + Vector::Constant(step), region(settings_.matrix_region)});
  }

  // Between a particle and the nearest of the lower sides of the box.
  double room(std::size_t i) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector& x : bodies_[i].surface(layers_thickness(settings_.particles[i])).points)
      least = std::min(least, (x - settings_.lower).minCoeff());
    return least;
  }

  void fill_with_tetrahedra() {
    input_.wanted_size = [this](const Vector& x) { return size_(x); };
    input_.max_radius_edge_ratio = settings_.max_radius_edge_ratio;
    input_.min_dihedral_angle = settings_.min_dihedral_angle;
    TetgenOutput tets = tetrahedralize_regions(input_);
    soup_.points = std::move(tets.points);
    for (std::size_t t = 0; t < tets.tetrahedra.size(); ++t)
      soup_.add_cell(CellShape::tetrahedron, tets.tetrahedra[t], tets.region[t]);
  }

  void add_layers(std::size_t i) {
    const Particle& p = settings_.particles[i];
    std::vector<Index>& first = first_[i];
    for (Index k = 1; k < p.n_layers; ++k) {
      first[k] = count_of(soup_.points);
      for (std::size_t x = 0; x < bodies_[i].n_points(); ++x)
        soup_.points.push_back(bodies_[i].point(x, p.layer_thickness * k / p.n_layers));
    }
    for (Index k = 0; k < p.n_layers; ++k)
      for (const auto& [a, b, c] : bodies_[i].triangles()) {
        const Index in = first[k];
        const Index out = first[k + 1];
        soup_.add_cell(CellShape::wedge, std::array{in + a, in + c, in + b, out + a, out + c, out + b},
                       region(p.layer_region));
      }
  }

  const ParticlesInBoxSettings& settings_;
  SizeField size_;
  TetgenInput input_;
  std::vector<NamedSurface> surfaces_;
  std::vector<ParticleBody> bodies_;
  std::vector<std::vector<Index>> first_;  // of each particle: first point of its surface, of each layer's far side
  CellSoup soup_;
};

}  // namespace

Mesh make_particles_in_box(const ParticlesInBoxSettings& settings) {
  check_particles_in_box(settings);
  Mesh mesh = Builder(settings).build();
  check_filled(mesh, settings);
  return mesh;
}

}  // namespace pfdm
