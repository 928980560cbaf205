#include "mesh/particles_in_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/box_surface.h"
#include "mesh/patch_rules.h"
#include "mesh/surface_checks.h"
#include "mesh/tetgen_wrapper.h"
#include "physics/error.h"

namespace pfdm {
namespace {

double outer_radius(const Particle& p) { return p.radius + (p.n_layers > 0 ? p.layer_thickness : 0.0); }

std::string describe_particle(const ParticlesInBoxSettings& settings, std::size_t i) {
  const Particle& p = settings.particles[i];
  return fmt::format("particle {} (centre {:g} {:g} {:g} m, radius {:g} m{})", i + 1, p.centre[0], p.centre[1],
                     p.centre[2], p.radius, p.n_layers > 0 ? fmt::format(", layers of {:g} m", p.layer_thickness) : "");
}

void check_positive(const std::string& what, double value) {
  if (!(value > 0.0)) throw InputError(fmt::format("{} is {:g}; it must be positive", what, value));
}

void check_particle(const ParticlesInBoxSettings& settings, std::size_t i) {
  const Particle& p = settings.particles[i];
  const std::string name = describe_particle(settings, i);
  if (!p.centre.allFinite()) throw InputError(name + " has a centre that is not finite");
  check_positive("the radius of " + name, p.radius);
  if (p.surface_size != 0.0 && p.subdivision != 0)
    throw InputError(fmt::format("{} has both a surface size ({:g} m) and a subdivision ({}); give one", name,
                                 p.surface_size, p.subdivision));
  if (p.subdivision == 0) check_positive("the surface size [m] of " + name, p.surface_size);
  if (p.subdivision < 0 || p.n_layers < 0)
    throw InputError(fmt::format("{} has the subdivision {} and {} layers; neither may be negative", name,
                                 p.subdivision, p.n_layers));
  if (p.n_layers > 0) check_positive("the thickness [m] of the layers of " + name, p.layer_thickness);
  const double room = std::min((p.centre - settings.lower).minCoeff(), (settings.upper - p.centre).minCoeff());
  if (!(outer_radius(p) < room))
    throw InputError(
        fmt::format("{} leaves the box or touches its side: it needs more than {:g} m from its centre to every "
                    "side and has {:g} m",
                    name, outer_radius(p), room));
}

void check_apart(const ParticlesInBoxSettings& settings, std::size_t i, std::size_t j) {
  const Particle& a = settings.particles[i];
  const Particle& b = settings.particles[j];
  const double distance = (a.centre - b.centre).norm();
  const double needed = outer_radius(a) + outer_radius(b);
  if (!(distance > needed))
    throw InputError(fmt::format("{} and {} overlap or touch: their centres are {:g} m apart and need more than {:g} m",
                                 describe_particle(settings, i), describe_particle(settings, j), distance, needed));
}

void check_settings(const ParticlesInBoxSettings& settings) {
  const Vector extent = settings.upper - settings.lower;
  if (!(extent.minCoeff() > 0.0) || !extent.allFinite())
    throw InputError(fmt::format("the box has the sides {:g}, {:g} and {:g} m; all must be positive", extent[0],
                                 extent[1], extent[2]));
  check_positive("the largest cell size (size_far) [m]", settings.size_far);
  check_positive("the largest cell size inside particles over that on their surface", settings.particle_size_factor);
  check_positive("the largest radius-edge ratio", settings.max_radius_edge_ratio);
  if (!(settings.grading >= 0.0))
    throw InputError(fmt::format("the grading is {:g}; it must be zero or positive", settings.grading));
  if (settings.boundary_size != 0.0) check_positive("the cell size on the box's surface [m]", settings.boundary_size);
  if (settings.particles.empty() && !std::isfinite(settings.size_far))
    throw InputError("a box without particles needs a cell size (size_far)");
  for (std::size_t i = 0; i < settings.particles.size(); ++i) check_particle(settings, i);
  for (std::size_t i = 0; i < settings.particles.size(); ++i)
    for (std::size_t j = i + 1; j < settings.particles.size(); ++j) check_apart(settings, i, j);
}

// A particle's surfaces in the list of all points.
struct Shells {
  TriangleSurface unit;      // directions of the points, and the triangles
  std::vector<Index> first;  // first point of the surface, of each layer's far side in turn
};

Index subdivision_of(const Particle& p) {
  return p.subdivision > 0 ? p.subdivision : icosphere_subdivision(p.surface_size, p.radius);
}

TriangleSurface unit_surface(const Particle& p) {
  if (!p.directions.triangles.empty()) return p.directions;
  TriangleSurface sphere = unit_icosphere(subdivision_of(p));
  const double c = std::cos(p.angle), s = std::sin(p.angle);
  for (Vector& x : sphere.points) x = Vector(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]);
  return sphere;
}

TriangleSurface placed(const TriangleSurface& unit, const Vector& centre, double radius) {
  TriangleSurface sphere = unit;
  for (Vector& x : sphere.points) x = centre + radius * x;
  return sphere;
}

SizeField size_field(const ParticlesInBoxSettings& settings) {
  std::vector<SizeSource> sources;
  for (const Particle& p : settings.particles) {
    const Index n = subdivision_of(p);
    const double core_size = icosphere_size(n, p.radius);
    sources.push_back({p.centre, outer_radius(p), icosphere_size(n, outer_radius(p)), p.radius, core_size,
                       settings.particle_size_factor * core_size});
  }
  return {std::move(sources), settings.grading, settings.size_far};
}

class Builder {
 public:
  explicit Builder(const ParticlesInBoxSettings& settings) : settings_(settings), size_(size_field(settings)) {}

  Mesh build() {
    for (std::size_t i = 0; i < settings_.particles.size(); ++i) add_particle_surfaces(i);
    add_surface("the box", box_surface(box_nodes()));
    check_surfaces(surfaces_);
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
    const auto first = static_cast<Index>(all.points.size());
    all.points.insert(all.points.end(), surface.points.begin(), surface.points.end());
    for (const Triangle& t : surface.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    surfaces_.push_back({name, surface});
    return first;
  }

  void add_particle_surfaces(std::size_t i) {
    const Particle& p = settings_.particles[i];
    Shells shells{unit_surface(p), {}};
    const std::string name = describe_particle(settings_, i);
    shells.first.push_back(add_surface(name, placed(shells.unit, p.centre, p.radius)));
    input_.seeds.push_back({p.centre, region(p.region)});
    if (p.n_layers > 0) {
      shells.first.resize(static_cast<std::size_t>(p.n_layers) + 1);
      shells.first.back() = add_surface("the layers of " + name, placed(shells.unit, p.centre, outer_radius(p)));
      input_.holes.push_back(p.centre + 0.5 * (p.radius + outer_radius(p)) * shells.unit.points[0]);
    }
    shells_.push_back(std::move(shells));
  }

  // Near a corner of the box, which no ball inside the box can reach.
  void add_matrix_seed() {
    double step = 0.01 * (settings_.upper - settings_.lower).minCoeff();
    for (const Particle& p : settings_.particles) step = std::min(step, 0.1 * p.radius);
    input_.seeds.push_back({settings_.lower + Vector::Constant(step), region(settings_.matrix_region)});
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
    Shells& shells = shells_[i];
    for (Index k = 1; k < p.n_layers; ++k) {
      shells.first[k] = static_cast<Index>(soup_.points.size());
      const double radius = p.radius + p.layer_thickness * k / p.n_layers;
      for (const Vector& direction : shells.unit.points) soup_.points.push_back(p.centre + radius * direction);
    }
    for (Index k = 0; k < p.n_layers; ++k)
      for (const auto& [a, b, c] : shells.unit.triangles) {
        const Index in = shells.first[k];
        const Index out = shells.first[k + 1];
        soup_.add_cell(CellShape::wedge, std::array{in + a, in + c, in + b, out + a, out + c, out + b},
                       region(p.layer_region));
      }
  }

  const ParticlesInBoxSettings& settings_;
  SizeField size_;
  TetgenInput input_;
  std::vector<NamedSurface> surfaces_;
  std::vector<Shells> shells_;
  CellSoup soup_;
};

// A gap or an overlap between layers and tetrahedra would show here: cells close and have positive volumes already.
void check_watertight(const Mesh& mesh, const ParticlesInBoxSettings& settings) {
  const Vector extent = settings.upper - settings.lower;
  const double filled = std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0);
  double surface = 0.0;
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f) surface += mesh.face_area[f].norm();
  const double box_surface_area = 2.0 * (extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0]);
  const auto differs = [](double a, double b) { return !(std::abs(a - b) <= 1e-9 * b); };
  if (differs(filled, extent.prod()) || differs(surface, box_surface_area))
    throw ComputationError(
        fmt::format("the mesh does not fill its box: volume {:.12g} of {:.12g} m^3, boundary {:.12g} of "
                    "{:.12g} m^2",
                    filled, extent.prod(), surface, box_surface_area));
}

}  // namespace

Mesh make_particles_in_box(const ParticlesInBoxSettings& settings) {
  check_settings(settings);
  Mesh mesh = Builder(settings).build();
  check_watertight(mesh, settings);
  return mesh;
}

}  // namespace pfdm
