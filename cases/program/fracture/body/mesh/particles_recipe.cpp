#include "cases/program/fracture/body/mesh/particles_recipe.h"

#include "cases/program/fracture/body/mesh/mesh_part_keys.h"

#include "cases/program/fracture/body/mesh/shape_recipe.h"
#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/amount.h"
#include "mesh/generators/packed_spheres.h"
#include "mesh/generators/particles_in_box.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

struct Layers {
  Index count = 0;
  double thickness = 0.0;  // of each [m]
  std::string region = "interface";
};

Layers read_layers(const ConfigTable& table) {
  return {.count = static_cast<Index>(table.integer("count")),
          .thickness = table.quantity("thickness"),
          .region = table.has("region") ? read_plain_name(table.at("region"), "a folder") : "interface"};
}

/// "20 um", or { ell = 1.0 } in multiples of the length ell.
double read_size(const ConfigValue& value, std::optional<double> ell) {
  if (!value.is_table()) return value.quantity();
  const double multiple = value.table().with_keys(size_keys()).number("ell");
  if (!ell) throw value.error("multiples of ell require a length in [fracture], as in length = \"20 um\"");
  return multiple * *ell;
}

/// `ell` becomes that of [fracture] if the size depends on it.
void read_edge_length(const ConfigTable& table, const MeshSurroundings& around, Particle& particle,
                      std::optional<double>& ell) {
  const auto size = table.find("surface_size");
  if (!size) return;
  particle.surface_size = read_size(*size, around.ell);
  if (size->is_table()) ell = around.ell;
}

void read_surface_size(const ConfigTable& table, const MeshSurroundings& around, Particle& particle,
                       std::optional<double>& ell) {
  if (table.has("subdivisions") == table.has("surface_size"))
    throw table.error("give either subdivisions, as in 8, or surface_size, as in \"20 um\" or { ell = 1.0 }");
  particle.subdivision = static_cast<Index>(table.integer("subdivisions", std::int64_t{0}));
  read_edge_length(table, around, particle, ell);
}

void set_layers(const Layers& layers, Particle& particle) {
  particle.n_layers = layers.count;
  particle.layer_thickness = layers.count * layers.thickness;
  particle.layer_region = layers.region;
}

Particle read_sphere(const ConfigTable& table, const MeshSurroundings& around, std::optional<double>& ell) {
  table.with_keys(particle_keys(), "sphere");
  Particle particle;
  particle.radius = 0.5 * table.quantity("diameter");
  read_surface_size(table, around, particle, ell);
  particle.angle = table.quantity("angle", particle.angle);
  return particle;
}

/// `shapes` gets an entry: that of the particle, or none.
Particle read_particle(const ConfigTable& table, const Layers& common_layers, const MeshSurroundings& around,
                       std::optional<double>& ell, std::vector<std::optional<ShapeRecipe>>& shapes) {
  shapes.emplace_back();
  if (table.has("surface")) shapes.back() = read_shape(table, around.case_directory);
  Particle particle;
  if (!shapes.back())
    particle = read_sphere(table, around, ell);
  else
    read_edge_length(table, around, particle, ell);
  if (const auto centre = table.find("centre")) particle.centre = read_point(*centre);
  particle.region = table.string("region", particle.region);
  set_layers(table.has("layers") ? read_layers(table.table("layers")) : common_layers, particle);
  return particle;
}

std::vector<std::string> names_of_regions(const ParticlesInBoxSettings& settings) {
  std::vector<std::string> names{settings.matrix_region};
  for (const Particle& particle : settings.particles) {
    names.push_back(particle.region);
    if (particle.n_layers > 0) names.push_back(particle.layer_region);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<Band> bands_of(const ParticlesInBoxSettings& settings) {
  std::vector<Band> bands;  // one a region: the first particle's stands for those that share it
  std::set<std::string> seen;
  for (const Particle& particle : settings.particles)
    if (particle.n_layers > 0 && seen.insert(particle.layer_region).second)
      bands.push_back({particle.layer_region, particle.layer_thickness, {particle.region, settings.matrix_region}});
  return bands;
}

ParticlesInBoxSettings read_box_of_tetrahedra(const ConfigTable& table) {
  ParticlesInBoxSettings settings;
  const Vector size = read_point(table.at("size"), range::positive);
  const auto centre_value = table.find("centre");
  const Vector centre = centre_value ? read_point(*centre_value) : Vector::Zero().eval();
  settings.lower = centre - 0.5 * size;
  settings.upper = centre + 0.5 * size;
  settings.matrix_region = table.string("region", settings.matrix_region);
  settings.size_far = table.quantity("size_far", settings.size_far);
  settings.boundary_size = table.quantity("boundary_size", settings.boundary_size);
  settings.grading = table.number("grading", settings.grading);
  settings.particle_size_factor = table.number("particle_size_factor", settings.particle_size_factor);
  settings.max_radius_edge_ratio = table.number("max_radius_edge_ratio", settings.max_radius_edge_ratio);
  settings.min_dihedral_angle = table.number("min_dihedral_angle", settings.min_dihedral_angle);
  return settings;
}

MeshRecipe recipe_of(const ParticlesInBoxSettings& settings, std::function<Mesh()> make) {
  MeshRecipe recipe;
  recipe.make = std::move(make);
  recipe.regions = names_of_regions(settings);
  recipe.patches = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  recipe.bands = bands_of(settings);
  return recipe;
}

DiameterDistribution read_distribution(const ConfigValue& value) {
  using Kind = DiameterDistribution::Kind;
  DiameterDistribution distribution;
  if (value.is_list()) {
    distribution.kind = Kind::list;
    for (const ConfigValue& entry : value.list()) distribution.values.push_back(entry.quantity());
    if (distribution.values.empty()) throw value.error("the list of diameters is empty");
    return distribution;
  }
  if (!value.is_table()) {
    distribution.mean = value.quantity();
    return distribution;
  }
  const ConfigTable table = value.table().with_keys(diameter_keys());
  const bool uniform = table.choice("distribution") == "uniform";
  distribution.kind = uniform ? Kind::uniform : Kind::lognormal;
  if (!uniform) {
    distribution.mean = table.quantity("mean");
    distribution.coefficient = table.number("coefficient");
  }
  const bool bounded = uniform || table.has("least") || table.has("most");
  if (!bounded) return distribution;
  distribution.least = uniform ? table.quantity("least") : table.quantity("least", 0.0);
  distribution.most = uniform ? table.quantity("most") : table.quantity("most", 0.0);
  if (distribution.most > 0.0 && distribution.most < distribution.least)
    throw table.error("the largest diameter (most) is smaller than the smallest (least)");
  return distribution;
}

void read_placed_spheres(const ConfigTable& table, PackedSpheresSettings& settings) {
  for (const std::string_view key : {"diameter", "count", "volume_fraction"})
    if (table.has(key)) throw table.at(key).error("it cannot be combined with [[mesh.spheres]], which says all");
  for (const ConfigTable& sphere : table.tables("spheres")) {
    settings.centres.push_back(read_point(sphere.at("centre")));
    settings.diameters.push_back(sphere.quantity("diameter"));
  }
}

void read_drawn_spheres(const ConfigTable& table, PackedSpheresSettings& settings) {
  const bool counted = table.has("count"), filled = table.has("volume_fraction"), sized = table.has("diameter");
  if (int(counted) + int(filled) + int(sized) < 2)
    throw table.error(
        "say which spheres: two of diameter, count and volume_fraction, or all three (the diameters are then only "
        "ratios), or [[mesh.spheres]]");
  const auto count = static_cast<Index>(table.integer("count", std::int64_t{0}));
  const double fraction = table.number("volume_fraction", 0.0);
  const double volume = fraction * (settings.box.upper - settings.box.lower).prod();
  const bool ratios = counted && filled;
  DiameterDistribution distribution{.mean = 1.0};
  if (sized) distribution = read_distribution(table.at("diameter"));
  settings.diameters =
      table.in_context([&] { return draw_diameters(distribution, count, volume, ratios, settings.seed); });
}

void read_packed_shapes(const ConfigTable& table, const std::filesystem::path& case_directory,
                        PackedSpheresSettings& settings, std::vector<std::filesystem::path>& files) {
  table.at("surface_size");  // the one size that there is
  for (const std::string_view key : {"spheres", "subdivisions", "edges_over_gap", "smallest_surface_size"})
    if (table.has(key)) throw table.at(key).error("it belongs to spheres and cannot be combined with [[mesh.shapes]]");
  for (const ConfigTable& shape : table.tables("shapes")) {
    settings.shapes.emplace_back(read_packed_shape(shape, case_directory));
    files.emplace_back(settings.shapes.back().given.name);
  }
}

Mesh with_shapes(ParticlesInBoxSettings settings, const std::vector<std::optional<ShapeRecipe>>& shapes) {
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (shapes[i]) settings.particles[i].shape = make_shape(*shapes[i], settings.particles[i].surface_size);
  return make_particles_in_box(settings);
}

}  // namespace

MeshRecipe read_particles_in_box(const ConfigTable& table, const MeshSurroundings& around) {
  ParticlesInBoxSettings settings = read_box_of_tetrahedra(table);
  const Layers layers = table.has("layers") ? read_layers(table.table("layers")) : Layers{};
  std::optional<double> ell;
  std::vector<std::optional<ShapeRecipe>> shapes;
  for (const ConfigTable& particle : table.tables("particles"))
    settings.particles.push_back(read_particle(particle, layers, around, ell, shapes));
  MeshRecipe recipe = recipe_of(settings, [settings, shapes] { return with_shapes(settings, shapes); });
  for (const auto& shape : shapes)
    if (shape) recipe.data_files.push_back(shape->file);
  recipe.ell = ell;
  return recipe;
}

MeshRecipe read_packed_spheres(const ConfigTable& table, const MeshSurroundings& around) {
  PackedSpheresSettings settings;
  settings.box = read_box_of_tetrahedra(table);
  settings.seed = static_cast<std::uint64_t>(table.integer("seed", std::int64_t{1}));
  settings.like.region = table.string("sphere_region", "particle");
  settings.numbered = table.boolean("numbered", false);
  std::optional<double> ell;
  std::vector<std::filesystem::path> files;
  if (table.has("shapes")) read_packed_shapes(table, around.case_directory, settings, files);
  read_surface_size(table, around, settings.like, ell);
  if (table.has("layers")) set_layers(read_layers(table.table("layers")), settings.like);
  settings.gap = table.quantity("gap");
  settings.wall_gap = table.quantity("wall_gap", settings.gap);
  settings.edges_over_gap = table.number("edges_over_gap", settings.edges_over_gap);
  settings.smallest_surface_size = table.number("smallest_surface_size", settings.smallest_surface_size);
  if (table.has("spheres"))
    read_placed_spheres(table, settings);
  else
    read_drawn_spheres(table, settings);
  ParticlesInBoxSettings example = settings.box;
  for (std::size_t i = 0; i < (settings.numbered ? settings.diameters.size() : 1); ++i) {
    example.particles.push_back(settings.like);
    if (settings.numbered) example.particles.back().region = numbered_region(settings.like.region, i);
  }
  MeshRecipe recipe = recipe_of(example, [settings] { return make_packed_spheres(settings); });
  recipe.data_files = std::move(files);
  recipe.ell = ell;
  return recipe;
}

}  // namespace pfdm
