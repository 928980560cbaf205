#include "cases/program/fracture/body/mesh/mesh_recipe.h"

#include "cases/program/fracture/body/mesh/particles_recipe.h"
#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/amount.h"
#include "mesh/dual.h"
#include "mesh/files/import_mesh.h"
#include "mesh/generators/box_hexes.h"
#include "mesh/generators/cylinder_sector.h"
#include "mesh/generators/sphere_sector.h"
#include "mesh/patch_rules.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string_view>

namespace pfdm {
namespace {

const std::vector<std::string> box_sides{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

AxisBlock read_block(const ConfigTable& block, std::string_view key) {
  return {.length = block.quantity(key),
          .n = static_cast<Index>(block.integer("cells")),
          .ratio = block.number("ratio", 1.0)};
}

/// [{ length = ..., cells = ..., ratio = ... }, ...], or with another key for the extent.
std::vector<AxisBlock> read_axis(const ConfigValue& blocks, std::string_view key) {
  std::vector<AxisBlock> axis;
  for (const ConfigValue& entry : blocks.list()) axis.push_back(read_block(entry.table(), key));
  if (axis.empty())
    throw blocks.error(fmt::format("the list is empty; it needs at least one {{ {} = ..., cells = ... }}", key));
  return axis;
}

template <class Settings>
std::vector<std::string> names_of_regions(const Settings& settings) {
  std::vector<std::string> names{settings.base_region};
  for (const auto& region : settings.regions) names.push_back(region.name);
  return names;
}

// Something with a name between two corners.
template <class NamedBox>
NamedBox read_box(const ConfigTable& table) {
  return {.name = table.string("name"), .lower = read_point(table.at("lower")), .upper = read_point(table.at("upper"))};
}

// A name that joins those of the other patches.
void add_patch(const ConfigTable& table, std::vector<std::string>& patches) {
  const std::string name = table.string("name");
  if (std::ranges::find(patches, name) != patches.end())
    throw table.at("name").error("another patch has this name already");
  patches.push_back(name);
}

template <class NamedBox>
NamedBox read_patch_box(const ConfigTable& table, std::vector<std::string>& patches) {
  NamedBox box = read_box<NamedBox>(table);
  add_patch(table, patches);
  return box;
}

MeshRecipe read_box_hexes(const ConfigTable& table, const MeshSurroundings&) {
  BoxHexesSettings settings;
  if (const auto origin = table.find("origin")) settings.origin = read_point(*origin);
  for (std::size_t a = 0; a < 3; ++a) settings.axes[a] = read_axis(table.at(std::string(1, "xyz"[a])), "length");
  settings.base_region = table.string("region", settings.base_region);
  for (const ConfigTable& region : table.tables("regions")) settings.regions.push_back(read_box<SubRegion>(region));
  std::vector<std::string> patches = box_sides;
  for (const ConfigTable& slit : table.tables("slits")) settings.slits.push_back(read_patch_box<Slit>(slit, patches));
  for (const ConfigTable& hole : table.tables("holes"))
    settings.holes.push_back(read_patch_box<SubRegion>(hole, patches));
  for (const ConfigTable& part : table.tables("patches"))
    settings.patches.push_back(read_patch_box<SurfacePart>(part, patches));
  return {.make = [settings] { return make_box_hexes(settings); },
          .regions = names_of_regions(settings),
          .patches = patches,
          .data_files = {}};
}

std::vector<Shell> read_shells(const ConfigValue& list) {
  std::vector<Shell> shells;
  for (const ConfigValue& entry : list.list()) {
    const ConfigTable shell = entry.table();
    shells.push_back({read_block(shell, "length"), shell.string("region")});
  }
  if (shells.empty())
    throw list.error("the list is empty; it needs at least one { length = ..., cells = ..., region = ... }");
  return shells;
}

MeshRecipe read_sphere_sector(const ConfigTable& table, const MeshSurroundings&) {
  const SphereSectorSettings settings{.azimuth = table.quantity("azimuth"),
                                      .inner_radius = table.quantity("inner_radius", 0.0),
                                      .shells = read_shells(table.at("shells")),
                                      .polar = read_axis(table.at("polar"), "angle")};
  std::vector<std::string> regions;
  for (const Shell& shell : settings.shells) regions.push_back(shell.region);
  std::vector<std::string> patches{"front", "back", "outer"};
  if (settings.inner_radius > 0.0) patches.emplace_back("inner");
  const auto add = [](double sum, const AxisBlock& block) { return sum + block.length; };
  if (std::accumulate(settings.polar.begin(), settings.polar.end(), 0.0, add) < 3.0) patches.emplace_back("equator");
  return {.make = [settings] { return make_sphere_sector(settings); },
          .regions = regions,
          .patches = patches,
          .data_files = {}};
}

// Two lengths in ascending order; equal ones are those of a line.
std::array<double, 2> read_extent(const ConfigValue& value) {
  const std::vector<ConfigValue> ends = value.list(2);
  const std::array<double, 2> extent{ends[0].quantity(), ends[1].quantity()};
  if (extent[0] > extent[1]) throw value.error("the first length must not be larger than the second one");
  return extent;
}

std::vector<SectorPart> read_parts(const ConfigTable& table, std::string_view key,
                                   std::vector<std::string>* patches = nullptr) {
  std::vector<SectorPart> parts;
  for (const ConfigTable& part : table.tables(key)) {
    const auto radius = read_extent(part.at("radius")), height = read_extent(part.at("height"));
    parts.push_back({part.string("name"), radius[0], radius[1], height[0], height[1]});
    if (patches) add_patch(part, *patches);
  }
  return parts;
}

MeshRecipe read_cylinder_sector(const ConfigTable& table, const MeshSurroundings&) {
  CylinderSectorSettings settings;
  settings.azimuth = table.quantity("azimuth");
  settings.inner_radius = table.quantity("inner_radius", 0.0);
  settings.bottom = table.quantity("bottom", 0.0);
  settings.radius = read_axis(table.at("radius"), "length");
  settings.height = read_axis(table.at("height"), "length");
  settings.upper_sphere = table.quantity("upper_sphere", 0.0);
  settings.base_region = table.string("region", settings.base_region);
  std::vector<std::string> patches{"front", "back", "outer", "bottom", "top"};
  if (settings.inner_radius > 0.0) patches.emplace_back("inner");
  settings.regions = read_parts(table, "regions");
  settings.slits = read_parts(table, "slits", &patches);
  settings.holes = read_parts(table, "holes", &patches);
  settings.patches = read_parts(table, "patches", &patches);
  return {.make = [settings] { return make_cylinder_sector(settings); },
          .regions = names_of_regions(settings),
          .patches = patches,
          .data_files = {}};
}

/// { 1 = "bead", 2 = "matrix" }
std::map<Index, std::string> read_numbered_names(const ConfigTable& table, std::string_view key) {
  std::map<Index, std::string> names;
  if (!table.has(key)) return names;
  for (const auto& [number, name] : table.table(key).entries()) {
    const auto index = parse_int(number);
    if (!index) throw name.error(fmt::format("expected a whole number, as in 1 = \"bead\", found \"{}\"", number));
    names[*index] = name.string();
  }
  return names;
}

// Of faces in a plane, or between two corners.
PatchRule read_patch(const ConfigTable& patch, double scale) {
  // A ten-thousandth of the file's unit: more than the rounding of coordinates in single precision.
  const double tolerance = patch.quantity("tolerance", 1e-4 * scale);
  if (patch.has("lower") || patch.has("upper")) {
    const auto box = read_box<SurfacePart>(patch);
    return patch_within(box.name, box.lower, box.upper, tolerance);
  }
  const int axis = patch.choice("axis")[0] - 'x';
  return plane_patch(patch.string("name"), axis, patch.quantity("at"), tolerance);
}

ImportSettings read_import(const ConfigTable& table, const std::filesystem::path& case_directory) {
  ImportSettings settings;
  settings.file = read_data_file(table.at("file"), case_directory);
  const ConfigValue unit = table.at("length_unit");
  settings.scale = unit.in_context([&] { return unit_in_si(unit.string(), dimension::length); });
  settings.region_names = read_numbered_names(table, "region_names");
  settings.face_sets = read_numbered_names(table, "face_sets");
  settings.merge_tolerance = table.quantity("merge_tolerance", 0.0);
  settings.thickness = table.quantity("thickness", 0.0);
  for (const ConfigTable& patch : table.tables("patches"))
    settings.patches.push_back(read_patch(patch, settings.scale));
  return settings;
}

// Regions and patches are known when the file is read.
MeshRecipe imported(const ImportSettings& settings, Mesh (*import)(const ImportSettings&)) {
  return {.make = [settings, import] { return import(settings); },
          .regions = {},
          .patches = {},
          .data_files = {settings.file}};
}

MeshRecipe read_vtk(const ConfigTable& table, const MeshSurroundings& around) {
  ImportSettings settings = read_import(table, around.case_directory);
  settings.region_array = table.string("region_array", "");
  settings.face_array = table.string("face_array", "");
  return imported(settings, import_vtk);
}

MeshRecipe read_gmsh(const ConfigTable& table, const MeshSurroundings& around) {
  return imported(read_import(table, around.case_directory), import_gmsh);
}

Mesh as_generated(Mesh mesh) { return mesh; }
Mesh polyhedra(Mesh mesh) { return barycentric_dual(mesh); }  // NOLINT(performance-unnecessary-value-param): a row

constexpr CellKind cell_kind_table[] = {
    {"as_generated", "the generator's own cells", as_generated},
    {"polyhedra", "the barycentric dual of tetrahedra and prisms: a polyhedron for each of their vertices", polyhedra},
};

constexpr MeshGenerator all_generators[] = {
    {"particles_in_box",
     "a box of tetrahedra with spheres, or particles from STL and OBJ files, in prism layers or without",
     read_particles_in_box},
    {"packed_spheres", "a box of tetrahedra with many spheres, packed at random or placed", read_packed_spheres},
    {"box_hexes", "a box of hexahedra, graded along each axis, with regions, slits and holes", read_box_hexes},
    {"cylinder_sector",
     "a sector of a cylinder about the axis z, one cell wide in azimuth, its upper end plane or spherical",
     read_cylinder_sector},
    {"sphere_sector", "concentric shells about the axis z, one cell wide in azimuth: axisymmetric problems",
     read_sphere_sector},
    {"vtk", "a mesh from a .vtu or legacy .vtk file", read_vtk},
    {"gmsh", "a mesh from a .msh file of Gmsh, regions and patches by its physical groups", read_gmsh},
};

}  // namespace

std::span<const MeshGenerator> mesh_generators() { return all_generators; }
std::span<const CellKind> cell_kinds() { return cell_kind_table; }

MeshRecipe read_mesh_recipe(const ConfigTable& settings, const MeshSurroundings& around) {
  const MeshGenerator& generator = choose(settings.at("generator"), mesh_generators(), "mesh generator");
  MeshRecipe recipe = generator.read(settings, around);
  const auto cells = settings.find("cells");
  const CellKind& kind = cells ? choose(*cells, cell_kinds(), "kind of cells") : cell_kind_table[0];
  recipe.make = [make = recipe.make, turn_into = kind.turn_into, settings] {
    return settings.in_context([&] { return turn_into(make()); });
  };
  return recipe;
}

}  // namespace pfdm
