#include "mesh/generators/particles_in_box_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/generators/expected_cells.h"
#include "mesh/surfaces/surface_checks.h"
#include "physics/error.h"
#include "physics/quantity_text.h"

namespace pfdm {
namespace {

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
  const Vector extent = settings.upper - settings.lower;
  const double edge = settings.size_far, cells = extent.prod() / (regular_volume * edge * edge * edge);
  if (!(cells < most_cells))
    throw InputError(fmt::format("the box would have about {:.3g} tetrahedra of {} (size_far), too many to number",
                                 cells, quantity_text(edge, "m", 3)));
  require_few_triangles("the box", area_of_sides(extent), settings.boundary_size > 0.0 ? settings.boundary_size : edge);
}

}  // namespace

std::string describe_particle(const ParticlesInBoxSettings& settings, std::size_t i) {
  const Particle& p = settings.particles[i];
  const std::string extent = is_sphere(p) ? fmt::format("radius {}", quantity_text(p.radius, "m", 6))
                                          : fmt::format("a surface of {} triangles", p.shape.triangles.size());
  return fmt::format("particle {} (centre {}, {}{})", i + 1, point_text(p.centre, 6), extent,
                     p.n_layers > 0 ? fmt::format(", layers of {}", quantity_text(p.layer_thickness, "m", 6)) : "");
}

void check_particles_in_box(const ParticlesInBoxSettings& settings) {
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

void check_filled(const Mesh& mesh, const ParticlesInBoxSettings& settings) {
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

}  // namespace pfdm
