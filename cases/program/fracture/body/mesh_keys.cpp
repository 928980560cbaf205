#include "cases/program/fracture/body/mesh_keys.h"

#include "cases/program/fracture/body/mesh_recipe.h"

#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr Range azimuth_range{std::numeric_limits<double>::min(), 0.25 * std::numbers::pi + 1e-9, false,
                              "more than 0 and at most 45 degrees"};
constexpr Range sharp_range{0.0, std::numbers::pi, true, "more than 0 and less than 180 degrees"};
constexpr Range radius_edge_range{1.1, 1e3, false, "between 1.1 and 1000"};
constexpr Range one_or_more{1.0, std::numeric_limits<double>::infinity(), false, "at least 1"};
constexpr Range dihedral_range{0.0, 20.0, false, "between 0 and 20 degrees"};
constexpr Range sphere_count{1.0, 5000.0, false, "between 1 and 5000"};
constexpr Range packable{0.0, 0.6, true, "between 0 and 0.6"};
constexpr Range up_to_one{1e-3, 1.0, false, "between 0.001 and 1"};

constexpr std::string_view of_tetrahedra = "particles_in_box packed_spheres";
constexpr std::string_view of_imports = "vtk gmsh";

KeyType edge_length() {
  using namespace keys;
  return either({quantity(dimension::length, range::positive), table(size_keys)});
}

std::vector<Key> block_keys(std::string_view extent, const Dimension& due, std::string_view sentence) {
  using namespace keys;
  return {{extent, quantity(due, range::positive), "", sentence},
          {"cells", whole(range::count), "", "Number of cells of the block along this axis."},
          {"ratio", number(range::positive), "1", "Grading: width of the block's last cell over that of its first."}};
}

const KeyTable& blocks_of_length() {
  static const KeyTable table{.name = "mesh.x[]",
                              .sentence = "A block of cells along an axis; blocks follow each other.",
                              .keys = block_keys("length", dimension::length, "Extent of the block along the axis.")};
  return table;
}

const KeyTable& blocks_of_angle() {
  static const KeyTable table{
      .name = "mesh.polar[]",
      .sentence = "A block of cells along the polar angle, from the axis z > 0 on.",
      .keys = block_keys("angle", dimension::angle, "Polar angle that the block takes, from the axis z > 0 on.")};
  return table;
}

const KeyTable& shell_keys() {
  static const KeyTable table = [] {
    KeyTable rows{.name = "mesh.shells[]",
                  .sentence = "A shell of the sphere, from the inside outwards.",
                  .keys = block_keys("length", dimension::length, "Thickness of the shell along the radius.")};
    rows.keys.push_back({"region", keys::text("name"), "", "Name of the shell's region; shells may share one."});
    return rows;
  }();
  return table;
}

const KeyTable& box_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.regions[]",
      .sentence = "A part of a box of hexahedra between two corners: a region, slit, hole or patch.",
      .keys = {
          {"name", text("name"), "", "Name of the region, or of the patch that the part makes."},
          {"lower", point(), "", "Lower corner of the part; cells or faces whose centre lies between belong to it."},
          {"upper", point(), "", "Upper corner of the part; of a slit equal to the lower one along one axis."}}};
  return table;
}

const KeyTable& sector_part_keys() {
  using namespace keys;
  const auto extent = list(quantity(dimension::length), 2, 2);
  static const KeyTable table{
      .name = "mesh.regions[] of cylinder_sector",
      .sentence = "A part of a cylinder's sector by radius and height: a region, slit, hole or patch.",
      .keys = {{"name", text("name"), "", "Name of the region, or of the patch that the part makes."},
               {"radius", extent, "", "Radius of the part, from and to; equal ones make a slit that is a tube."},
               {"height", extent, "",
                "Height of the part, from and to, before the upper end is curved; equal ones make a disc or ring."}}};
  return table;
}

const KeyTable& imported_patch_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.patches[] of vtk and gmsh",
      .sentence = "A patch of an imported mesh: its faces in a plane, or between two corners.",
      .keys = {{"name", text("name"), "", "Name of the patch."},
               {"axis", choice("axis", {"x", "y", "z"}), "with lower and upper none",
                "Axis that is normal to the plane of the patch's faces."},
               {"at", quantity(dimension::length), "with lower and upper none", "Where the plane lies along the axis."},
               {"tolerance", quantity(dimension::length, range::positive), "a ten-thousandth of length_unit",
                "Distance from the plane, or from the corners' box, within which faces belong to the patch."},
               {"lower", point(), "with axis and at none",
                "Lower corner; surface faces whose centre lies between are taken."},
               {"upper", point(), "with axis and at none", "Upper corner of the box that holds the patch's faces."}}};
  return table;
}

const KeyTable& layer_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.layers",
      .sentence = "Prism layers around particles, in which an interface of finite thickness may break.",
      .keys = {{"count", whole(range::count), "", "Number of prism layers around the particle."},
               {"thickness", quantity(dimension::length, range::positive), "", "Thickness of each prism layer."},
               {"region", text("plain name"), "\"interface\"", "Name of the region that the prism layers are."}}};
  return table;
}

const KeyTable& placed_sphere_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.spheres[]",
      .sentence = "A sphere that is placed instead of packed at random.",
      .keys = {{"centre", point(), "", "Centre of the placed sphere."},
               {"diameter", quantity(dimension::length, range::positive), "", "Diameter of the placed sphere."}}};
  return table;
}

const KeyTable& packed_shape_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.shapes[]",
      .sentence = "A body from a surface file that is packed in place of spheres.",
      .keys = {{"surface", path(), "", "File of the body's closed surface, .stl or .obj, seen from the case."},
               {"sharp_angle", quantity(dimension::angle, sharp_range), "\"45 degree\"",
                "Edges at which the surface turns by more are kept, others are rounded off."}}};
  return table;
}

std::vector<Key> keys_of_tetrahedra() {
  using namespace keys;
  return {
      {"size", point(range::positive), "", "Sides of the box along x, y and z.", of_tetrahedra},
      {"centre", point(), "the origin", "Centre of the box.", of_tetrahedra},
      {"region", text("name"), "\"matrix\"", "Name of the matrix, the region around the particles.", of_tetrahedra},
      {"size_far", quantity(dimension::length, range::positive), "no limit",
       "Largest wanted edge of a tetrahedron, far from the particles.", of_tetrahedra},
      {"boundary_size", quantity(dimension::length, range::positive), "as in the volume there",
       "Wanted length of edges on the surface of the box.", of_tetrahedra},
      {"grading", number(range::not_negative), "0.4",
       "Growth of the tetrahedra's edges per distance from the nearest particle.", of_tetrahedra},
      {"particle_size_factor", number(one_or_more), "no limit",
       "Edges inside a sphere over those on its surface, at most; 1 is uniform.", of_tetrahedra},
      {"max_radius_edge_ratio", number(radius_edge_range), "1.4",
       "Largest ratio of circumscribed radius to shortest edge of tetrahedra, their quality.", of_tetrahedra},
      {"min_dihedral_angle", number(dihedral_range), "10",
       "Smallest dihedral angle of tetrahedra in degrees, as far as the surfaces allow.", of_tetrahedra},
      {"layers", table(layer_keys), "no layers", "Prism layers around every particle.", of_tetrahedra},
      {"particles", tables(particle_keys), "none: a box of matrix",
       "Particles in the box, spheres or bodies from surface files.", "particles_in_box"},
  };
}

std::vector<Key> keys_of_packing() {
  using namespace keys;
  constexpr std::string_view packed = "packed_spheres";
  return {
      {"diameter",
       either({quantity(dimension::length, range::positive), list(quantity(dimension::length, range::positive), 1),
               table(diameter_keys)}),
       "with count and volume_fraction: all equal",
       "Diameters of the packed spheres: one, a list taken in turn, or a random distribution.", packed},
      {"count", whole(sphere_count), "by diameter and volume_fraction", "Number of packed spheres.", packed},
      {"volume_fraction", number(packable), "by diameter and count",
       "Volume of all packed spheres over that of the box, the filler content.", packed},
      {"gap", quantity(dimension::length, range::positive), "",
       "Least distance between two packed bodies, layers included.", packed},
      {"wall_gap", quantity(dimension::length, range::positive), "gap",
       "Least distance of packed bodies from the sides of the box.", packed},
      {"seed", whole(range::seed), "1", "Seed of the random diameters, places and directions of the packing.", packed},
      {"spheres", tables(placed_sphere_keys), "packed at random", "Spheres that are placed instead of packed.", packed},
      {"sphere_region", text("name"), "\"particle\"", "Name of the region of the packed spheres.", packed},
      {"numbered", flag(), "false", "Whether each sphere is a region of its own, particle_1, particle_2 ...", packed},
      {"subdivisions", whole(range::count), "or surface_size",
       "Number n: the surface of a sphere has 20 n^2 triangles.", packed},
      {"surface_size", edge_length(), "or subdivisions",
       "Length of the edges on the particles' surface, or { ell = 1.0 } in multiples of the phase-field length.",
       packed},
      {"edges_over_gap", number(range::not_negative), "1",
       "Edges where a surface is near another are at most this times the distance; 0: as elsewhere.", packed},
      {"smallest_surface_size", number(up_to_one), "0.5", "Least edges near other surfaces over those elsewhere.",
       packed},
      {"shapes", tables(packed_shape_keys), "spheres",
       "Bodies from surface files, taken in turn, packed and turned at random in place of spheres.", packed},
  };
}

std::vector<Key> keys_of_hexahedra() {
  using namespace keys;
  constexpr std::string_view hexes = "box_hexes";
  const auto blocks = list(table(blocks_of_length), 1);
  return {
      {"x", blocks, "", "Blocks of cells along x, each with length, number of cells and grading.", hexes},
      {"y", blocks, "", "Blocks of cells along y, each with length, number of cells and grading.", hexes},
      {"z", blocks, "", "Blocks of cells along z, each with length, number of cells and grading.", hexes},
      {"origin", point(), "the origin", "Lower corner of the box.", hexes},
      {"region", text("name"), "\"body\"", "Name of the region of all cells that no other region takes.",
       "box_hexes cylinder_sector"},
      {"regions", tables(box_keys), "none", "Regions by cells whose centre lies between two corners; later ones win.",
       hexes},
      {"slits", tables(box_keys), "none",
       "Rectangles of the grid along which the body is cut, as a notch; both faces are a patch.", hexes},
      {"holes", tables(box_keys), "none", "Cells that are left out, as a notch or hole; the new surface is a patch.",
       hexes},
      {"patches", tables(box_keys), "none", "Parts of the surface that are patches of their own, as a support.", hexes},
  };
}

std::vector<Key> keys_of_sectors() {
  using namespace keys;
  constexpr std::string_view both = "cylinder_sector sphere_sector", cylinder = "cylinder_sector",
                             sphere = "sphere_sector";
  const auto blocks = list(table(blocks_of_length), 1);
  return {
      {"azimuth", quantity(dimension::angle, azimuth_range), "", "Width of the sector about the axis z, one cell wide.",
       both},
      {"inner_radius", quantity(dimension::length, range::not_negative), "0: full",
       "Radius at which the mesh begins, of a tube or hollow sphere.", both},
      {"radius", blocks, "", "Blocks of cells along the radius, from the inside outwards.", cylinder},
      {"bottom", quantity(dimension::length), "0", "Height z at which the cylinder begins.", cylinder},
      {"height", blocks, "", "Blocks of cells along the axis z, from the bottom upwards.", cylinder},
      {"upper_sphere", quantity(dimension::length, range::positive), "0: plane",
       "Radius of the sphere that the cylinder's upper end is part of, as of a lens.", cylinder},
      {"regions", tables(sector_part_keys), "none",
       "Regions by radius and height of their cells' centres; later ones win.", cylinder},
      {"slits", tables(sector_part_keys), "none",
       "Cuts of the cylinder, discs, rings or tubes, whose faces are a patch.", cylinder},
      {"holes", tables(sector_part_keys), "none",
       "Cells of the cylinder that are left out; the new surface is a patch.", cylinder},
      {"patches", tables(sector_part_keys), "none", "Parts of the cylinder's surface that are patches of their own.",
       cylinder},
      {"shells", list(table(shell_keys), 1), "", "Shells of the sphere from the inside, each with its region.", sphere},
      {"polar", list(table(blocks_of_angle), 1), "",
       "Blocks of cells along the polar angle, together 90 or 180 degrees.", sphere},
  };
}

std::vector<Key> keys_of_imports() {
  using namespace keys;
  return {
      {"file", path(), "", "File of the mesh, .vtu, legacy .vtk, or .msh of Gmsh, seen from the case.", of_imports},
      {"length_unit", unit(dimension::length), "", "Unit of the coordinates in the mesh file, as in \"mm\".",
       of_imports},
      {"region_array", text("name"), "the first known", "Name of the file's cell array with the numbers of regions.",
       "vtk"},
      {"region_names", names(text("name")), "Gmsh's, or region_<number>",
       "Names of regions by their number in the mesh file.", of_imports},
      {"face_array", text("name"), "as of the regions", "Name of the file's array with patch numbers on faces.", "vtk"},
      {"face_sets", names(text("name")), "Gmsh's, or patch_<number>",
       "Names of patches by their number in the mesh file.", of_imports},
      {"merge_tolerance", quantity(dimension::length, range::not_negative), "\"0 um\"",
       "Distance below which points of the mesh file become one.", of_imports},
      {"thickness", quantity(dimension::length, range::positive), "flat meshes are refused",
       "Thickness of a flat mesh, whose cells become one layer.", of_imports},
      {"patches", tables(imported_patch_keys), "xmin ... zmax where no patch is named",
       "Patches of an imported mesh by plane or corners; earlier ones win.", of_imports},
  };
}

}  // namespace

const KeyTable& size_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "size",
      .sentence = "A length in multiples of the phase-field length.",
      .keys = {{"ell", number(range::positive), "", "Multiple of the phase-field length ell that [fracture] gives."}}};
  return table;
}

const KeyTable& diameter_keys() {
  using namespace keys;
  const auto length = quantity(dimension::length, range::positive);
  static const KeyTable table{
      .name = "mesh.diameter",
      .sentence = "A random distribution of the diameters of packed spheres, by number.",
      .keys = {{"distribution", choice("distribution of diameters", {"uniform", "lognormal"}), "",
                "Kind of random distribution of the diameters."},
               {"least", length, "with lognormal none", "Smallest diameter of the distribution."},
               {"most", length, "with lognormal none", "Largest diameter of the distribution."},
               {"mean", length, "", "Mean diameter of the lognormal distribution.", "lognormal"},
               {"coefficient", number(range::not_negative), "",
                "Coefficient of variation of the diameters, standard deviation over mean.", "lognormal"}},
      .decided_by = "distribution"};
  return table;
}

const KeyTable& particle_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh.particles[]",
      .sentence = "A particle in the box: a sphere, or a body from a surface file.",
      .keys = {{"centre", point(), "the origin", "Centre of the sphere, or where the body's centroid lies."},
               {"diameter", quantity(dimension::length, range::positive), "or length_unit of a surface file",
                "Diameter of the sphere, or of the sphere of the same volume as the body."},
               {"region", text("name"), "\"bead\"", "Name of the particle's region."},
               {"surface", path(), "none: a sphere",
                "File of the particle's closed surface, .stl or .obj, seen from the case."},
               {"subdivisions", whole(range::count), "or surface_size",
                "Number n: the surface of the sphere has 20 n^2 triangles.", "sphere"},
               {"surface_size", edge_length(), "or subdivisions of a sphere",
                "Edge length on the particle's surface, or { ell = 1.0 } in multiples of the phase-field length."},
               {"angle", quantity(dimension::angle), "0",
                "Angle by which the particle is turned, a sphere's icosahedron about z, a body about axis."},
               {"axis", direction(), "[0, 0, 1]", "Axis through its centroid about which a body is turned.", "file"},
               {"length_unit", unit(dimension::length), "or diameter",
                "Unit of the coordinates in the surface file, as in \"mm\".", "file"},
               {"scale", number(range::positive), "1",
                "Factor of the surface file's coordinates, beside their length_unit.", "file"},
               {"sharp_angle", quantity(dimension::angle, sharp_range), "\"45 degree\"",
                "Edges at which the surface turns by more are kept, others are rounded off.", "file"},
               {"layers", keys::table(layer_keys), "[mesh.layers]", "Prism layers around this particle."}},
      .decided_by_reader = true};
  return table;
}

const KeyTable& mesh_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "mesh",
      .sentence = "The mesh of the body: a generator with its settings, or an imported file.",
      .keys = joined({{{"generator", one_of("mesh generator", mesh_generators()), "",
                        "What makes the mesh: a generator of boxes, particles, sectors, or an imported file."},
                       {"cells", one_of("kind of cells", cell_kinds()), "\"as_generated\"",
                        "Cells as they are generated, or polyhedra: the barycentric dual of tetrahedra and prisms."}},
                      keys_of_tetrahedra(),
                      keys_of_packing(),
                      keys_of_hexahedra(),
                      keys_of_sectors(),
                      keys_of_imports()}),
      .decided_by = "generator"};
  return table;
}

}  // namespace pfdm
