#include "mesh/generators/particles_in_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/generators/tetgen_wrapper.h"
#include "mesh/patch_rules.h"
#include "mesh/surfaces/box_surface.h"
#include "mesh/surfaces/particle_shape.h"
#include "mesh/surfaces/surface_checks.h"
#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

double thickness(const Particle& p) { return p.n_layers > 0 ? p.layer_thickness : 0.0; }
double outer_radius(const Particle& p) { return p.radius + thickness(p); }
bool is_sphere(const Particle& p) { return p.shape.triangles.empty(); }

std::string describe_particle(const ParticlesInBoxSettings& settings, std::size_t i) {
  const Particle& p = settings.particles[i];
  const std::string extent = is_sphere(p) ? fmt::format("radius {}", quantity_text(p.radius, "m", 6))
                                          : fmt::format("a surface of {} triangles", p.shape.triangles.size());
  return fmt::format("particle {} (centre {}, {}{})", i + 1, point_text(p.centre, 6), extent,
                     p.n_layers > 0 ? fmt::format(", layers of {}", quantity_text(p.layer_thickness, "m", 6)) : "");
}

void check_positive(const std::string& what, double value) {
  if (!(value > 0.0)) throw InputError(fmt::format("{} is {:g}; it must be positive", what, value));
}

void check_sphere_in_box(const ParticlesInBoxSettings& settings, const Particle& p, const std::string& name) {
  check_positive("the radius of " + name, p.radius);
  const double room = std::min((p.centre - settings.lower).minCoeff(), (settings.upper - p.centre).minCoeff());
  if (!(outer_radius(p) < room))
    throw InputError(fmt::format(
        "{} leaves the box or touches its side: it needs more than {} from its centre to every side and has {}", name,
        quantity_text(outer_radius(p), "m", 6), quantity_text(room, "m", 6)));
}

void check_particle(const ParticlesInBoxSettings& settings, std::size_t i) {
  const Particle& p = settings.particles[i];
  const std::string name = describe_particle(settings, i);
  if (!p.centre.allFinite()) throw InputError(name + " has a centre that is not finite");
  if (p.surface_size != 0.0 && p.subdivision != 0)
    throw InputError(fmt::format("{} has both a surface size ({}) and a subdivision ({}); give one", name,
                                 quantity_text(p.surface_size, "m", 6), p.subdivision));
  if (p.subdivision == 0) check_positive("the surface size [m] of " + name, p.surface_size);
  if (p.subdivision < 0 || p.n_layers < 0)
    throw InputError(fmt::format("{} has the subdivision {} and {} layers; neither may be negative", name,
                                 p.subdivision, p.n_layers));
  if (p.n_layers > 0) check_positive("the thickness [m] of the layers of " + name, p.layer_thickness);
  if (is_sphere(p)) check_sphere_in_box(settings, p, name);
}

void check_apart(const ParticlesInBoxSettings& settings, std::size_t i, std::size_t j) {
  const Particle& a = settings.particles[i];
  const Particle& b = settings.particles[j];
  if (!is_sphere(a) || !is_sphere(b)) return;  // their surfaces are checked
  const double distance = (a.centre - b.centre).norm();
  const double needed = outer_radius(a) + outer_radius(b);
  if (!(distance > needed))
    throw InputError(fmt::format("{} and {} overlap or touch: their centres are {} apart and need more than {}",
                                 describe_particle(settings, i), describe_particle(settings, j),
                                 quantity_text(distance, "m", 6), quantity_text(needed, "m", 6)));
}

double area_of_sides(const Vector& extent) {
  return 2.0 * (extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0]);
}

/// Of the box; the cells that particles add are limited by the triangles of their surfaces.
void check_number_of_cells(const ParticlesInBoxSettings& settings) {
  constexpr double regular = 0.1178, most = std::numeric_limits<Index>::max() / 24.0;
  const Vector extent = settings.upper - settings.lower;
  const double edge = settings.size_far, cells = extent.prod() / (regular * edge * edge * edge);
  if (!(cells < most))
    throw InputError(fmt::format("the box would have about {:.3g} tetrahedra of {} (size_far), too many to number",
                                 cells, quantity_text(edge, "m", 3)));
  require_few_triangles("the box", area_of_sides(extent), settings.boundary_size > 0.0 ? settings.boundary_size : edge);
}

void check_settings(const ParticlesInBoxSettings& settings) {
  const Vector extent = settings.upper - settings.lower;
  if (!(extent.minCoeff() > 0.0) || !extent.allFinite())
    throw InputError(fmt::format("the box has the sides {}; all must be positive",
                                 quantities_text({extent[0], extent[1], extent[2]}, "m", ", ", 6)));
  check_positive("the largest cell size (size_far) [m]", settings.size_far);
  check_positive("the largest cell size inside particles over that on their surface", settings.particle_size_factor);
  if (std::isfinite(settings.particle_size_factor) && !std::ranges::all_of(settings.particles, is_sphere))
    throw InputError("the largest cell size inside particles (particle_size_factor) can be limited in spheres only");
  check_positive("the largest radius-edge ratio", settings.max_radius_edge_ratio);
  if (!(settings.grading >= 0.0))
    throw InputError(fmt::format("the grading is {:g}; it must be zero or positive", settings.grading));
  if (settings.boundary_size != 0.0) check_positive("the cell size on the box's surface [m]", settings.boundary_size);
  if (settings.particles.empty() && !std::isfinite(settings.size_far))
    throw InputError("a box without particles needs a cell size (size_far)");
  check_number_of_cells(settings);
  for (std::size_t i = 0; i < settings.particles.size(); ++i) check_particle(settings, i);
  for (std::size_t i = 0; i < settings.particles.size(); ++i)
    for (std::size_t j = i + 1; j < settings.particles.size(); ++j) check_apart(settings, i, j);
}

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
  std::vector<Vector> points = ParticleBody(p).surface(thickness(p)).points;
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
      const Vector x = bodies_[i].point(0, thickness(settings_.particles[i]));
      if (!((x - settings_.lower).minCoeff() > 0.0) || !((settings_.upper - x).minCoeff() > 0.0))
        throw InputError(fmt::format("{} leaves the box", describe_particle(settings_, i)));
      for (std::size_t j = 0; j < bodies_.size(); ++j)
        if (const Particle& other = settings_.particles[j]; i != j &&
                                                            !(is_sphere(settings_.particles[i]) && is_sphere(other)) &&
                                                            encloses(bodies_[j].surface(thickness(other)), x))
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
    for (const Vector& x : bodies_[i].surface(thickness(settings_.particles[i])).points)
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

// A gap or an overlap between layers and tetrahedra would show here: cells close and have positive volumes already.
void check_watertight(const Mesh& mesh, const ParticlesInBoxSettings& settings) {
  const Vector extent = settings.upper - settings.lower;
  const double filled = std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0);
  double surface = 0.0;
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) surface += mesh.face_area[f].norm();
  const double box_surface_area = area_of_sides(extent);
  const auto differs = [](double a, double b) { return !(std::abs(a - b) <= 1e-9 * b); };
  if (differs(filled, extent.prod()) || differs(surface, box_surface_area))
    throw ComputationError(fmt::format("the mesh does not fill its box: volume {:.12g} of {}, boundary {:.12g} of {}",
                                       filled, quantity_text(extent.prod(), "m^3", 12), surface,
                                       quantity_text(box_surface_area, "m^2", 12)));
}

}  // namespace

Mesh make_particles_in_box(const ParticlesInBoxSettings& settings) {
  check_settings(settings);
  Mesh mesh = Builder(settings).build();
  check_watertight(mesh, settings);
  return mesh;
}

}  // namespace pfdm
