#include "cases/program/fracture/body/mesh/mesh_keys.h"

#include "cases/program/fracture/body/mesh/mesh_part_keys.h"
#include "cases/program/fracture/body/mesh/mesh_recipe.h"

#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

namespace pfdm {
namespace {

constexpr Range azimuth_range{std::numeric_limits<double>::min(), 0.25 * std::numbers::pi + 1e-9, false,
                              "more than 0 and at most 45 degrees"};
constexpr Range radius_edge_range{1.1, 1e3, false, "between 1.1 and 1000"};
constexpr Range one_or_more{1.0, std::numeric_limits<double>::infinity(), false, "at least 1"};
constexpr Range dihedral_range{0.0, 20.0, false, "between 0 and 20 degrees"};
constexpr Range sphere_count{1.0, 5000.0, false, "between 1 and 5000"};
constexpr Range packable{0.0, 0.6, true, "between 0 and 0.6"};
constexpr Range up_to_one{1e-3, 1.0, false, "between 0.001 and 1"};

constexpr std::string_view of_tetrahedra = "particles_in_box packed_spheres";
constexpr std::string_view of_imports = "vtk gmsh";

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
      {"layers", table(particle_layer_keys), "no layers", "Prism layers around every particle.", of_tetrahedra},
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
      {"regions", tables(box_part_keys), "none",
       "Regions by cells whose centre lies between two corners; later ones win.", hexes},
      {"slits", tables(box_part_keys), "none",
       "Rectangles of the grid along which the body is cut, as a notch; both faces are a patch.", hexes},
      {"holes", tables(box_part_keys), "none",
       "Cells that are left out, as a notch or hole; the new surface is a patch.", hexes},
      {"patches", tables(box_part_keys), "none", "Parts of the surface that are patches of their own, as a support.",
       hexes},
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
