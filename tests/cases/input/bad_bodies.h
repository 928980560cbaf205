#pragma once
// What is wrong with the mesh, the materials and the initial damage of the bar.

#include "tests/cases/temporary_case.h"

namespace pfdm {

inline constexpr const char* hexahedra_of_bar = R"(generator = "box_hexes"
x = [{ length = "20 mm", cells = 21 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 1 }]
region = "bar"
[[mesh.regions]]
name = "weak"
lower = ["9.6 mm", "-1 mm", "-1 mm"]
upper = ["10.4 mm", "2 mm", "2 mm"]
)";

inline const BadInput bad_bodies[] = {
    {"material_that_depends_on_the_load",
     "poisson_ratio = 0.2",
     "poisson_ratio = { expr = \"0.2*t\" }",
     {"case.toml:18: [materials.concrete] poisson_ratio: this may depend on x, y and z (metres) only"}},
    {"material_out_of_range_in_a_cell",
     "poisson_ratio = 0.2",
     "poisson_ratio = { expr = \"60*x\" }",
     {"case.toml:18: [materials.concrete] poisson_ratio: ", "m must be above -1 and at most 0.4999"}},
    {"varying_material_without_unit",
     "young_modulus = \"30 GPa\"",
     "young_modulus = { expr = \"30 + x\" }",
     {"[materials.concrete.young_modulus] \"unit\" is missing"}},
    {"initial_damage_beyond_one",
     "[loading]",
     "[initial]\ndamage = { expr = \"100*x\" }\n[loading]",
     {"[initial] damage: ", "m must be between 0 and 1"}},
    {"initial_damage_with_history",
     "[fracture]",
     "[initial]\ndamage = 0.5\n[fracture]\nirreversibility = \"history\"",
     {"[initial] damage: this requires the irreversibility \"bounds\""}},
    {"initial_crack_with_history",
     "[fracture]",
     "[initial]\ncracks = [{ points = [[\"1 mm\", \"0 mm\", \"0 mm\"], [\"1 mm\", \"1 mm\", \"0 mm\"]] }]\n"
     "[fracture]\nirreversibility = \"history\"",
     {"[initial] cracks: this requires the irreversibility \"bounds\""}},
    {"initial_crack_beside_the_body",
     "[fracture]",
     "[[initial.cracks]]\npoints = [[\"1 mm\", \"2 mm\", \"0 mm\"], [\"3 mm\", \"2 mm\", \"0 mm\"]]\n[fracture]",
     {"[initial.cracks]", "the crack goes through no cell that can be damaged"}},
    {"initial_crack_of_one_point",
     "[fracture]",
     "[[initial.cracks]]\npoints = [[\"1 mm\", \"0 mm\", \"0 mm\"]]\n[fracture]",
     {"[initial.cracks] points: expected two points, or the corners of a polygon"}},
    {"initial_crack_along_its_front",
     "[fracture]",
     "[[initial.cracks]]\npoints = [[\"1 mm\", \"0 mm\", \"0 mm\"], [\"1 mm\", \"0 mm\", \"1 mm\"]]\n[fracture]",
     {"[initial.cracks] points: ", "they span no surface"}},
    {"initial_disc_with_points",
     "[fracture]",
     "[[initial.cracks]]\nradius = \"1 mm\"\npoints = [[\"1 mm\", \"0 mm\", \"0 mm\"], [\"3 mm\", \"0 mm\", \"0 "
     "mm\"]]\n"
     "[fracture]",
     {"[initial.cracks] radius: this belongs to a disc"}},
    {"initial_damage_in_a_region_that_is_not_there",
     "[fracture]",
     "[initial]\ndamage = 1.0\nregions = [\"weka\"]\n[fracture]",
     {"[initial] regions[0]: \"weka\" is not a region of the mesh; did you mean \"weak\"?"}},
    {"initial_damage_in_no_region",
     "[fracture]",
     "[initial]\ndamage = 1.0\nregions = []\n[fracture]",
     {"[initial] regions: the list is empty"}},
    {"region_that_is_not_there",
     "[\"bar\", \"weak\"]",
     "[\"baar\", \"weak\"]",
     {"case.toml:16: [materials.concrete] regions[0]: \"baar\" is not a region of the mesh; did you mean \"bar\"?"}},
    {"region_without_material",
     "regions = [\"bar\", \"weak\"]\n",
     "regions = [\"weak\"]\n",
     {"region \"bar\" of the mesh has no material"}},
    {"region_with_two_materials",
     "regions = [\"bar\", \"weak\"]\n",
     "regions = [\"bar\", \"weak\", \"bar\"]\n",
     {"region \"bar\" already has a material"}},
    {"override_of_no_region", "[regions.weak]", "[regions.weaker]", {"region \"weaker\" has no material"}},
    {"material_without_toughness",
     "toughness = \"100 J/m^2\"\n",
     "",
     {"case.toml:15: [materials.concrete] region \"bar\" can be damaged but has no toughness (Gc)"}},
    {"material_without_length", "length = \"4 mm\"\n", "", {"region \"bar\" can be damaged but has no length (ell)"}},
    {"negative_size", "\"20 mm\"", "\"-20 mm\"", {"case.toml:6: [mesh.x] length: \"-20 mm\" must be positive"}},
    {"no_cells", "cells = 21", "cells = 0", {"cells: 0 must be between 1 and 1000000"}},
    {"cells_without_end", "cells = 21", "cells = 100000000", {"cells: 100000000 must be between 1 and 1000000"}},
    {"poisson_ratio_of_a_half",
     "poisson_ratio = 0.2",
     "poisson_ratio = 0.5",
     {"0.5 must be above -1 and at most 0.4999"}},
    {"poisson_ratio_beyond_the_limit",
     "poisson_ratio = 0.2",
     "poisson_ratio = 0.49991",
     {"case.toml:18: [materials.concrete] poisson_ratio: 0.49991 must be above -1 and at most 0.4999"}},
    {"region_with_no_cell", "\"9.6 mm\", \"-1 mm\"", "\"10.39 mm\", \"-1 mm\"", {"case.toml:4: [mesh]", "weak"}},
    {"hole_with_no_cell",
     "[[mesh.regions]]",
     "[[mesh.holes]]\nname = \"gap\"\nlower = [\"1 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"1.1 mm\", \"1 mm\", \"1 "
     "mm\"]\n"
     "[[mesh.regions]]",
     {"case.toml:4: [mesh]", "hole \"gap\" of the box contains no cell's centre"}},
    {"patch_with_no_face",
     "[[mesh.regions]]",
     "[[mesh.patches]]\nname = \"pin\"\nlower = [\"1 mm\", \"2 mm\", \"0 mm\"]\nupper = [\"2 mm\", \"2 mm\", \"1 "
     "mm\"]\n"
     "[[mesh.regions]]",
     {"case.toml:4: [mesh]", "no boundary face of the mesh belongs to patch \"pin\""}},
    {"patch_with_the_name_of_a_side",
     "[[mesh.regions]]",
     "[[mesh.patches]]\nname = \"xmin\"\nlower = [\"1 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"2 mm\", \"0 mm\", \"1 "
     "mm\"]\n"
     "[[mesh.regions]]",
     {"another patch has this name already"}},
    {"unknown_generator", "\"box_hexes\"", "\"box_hexe\"", {"is not a mesh generator; did you mean \"box_hexes\"?"}},
    {"polyhedra_of_hexahedra",
     "\"box_hexes\"",
     "\"box_hexes\"\ncells = \"polyhedra\"",
     {"case.toml:4: [mesh]", "polyhedra are made of tetrahedra, wedges and pyramids; 42 of the mesh's 42 cells"}},
    {"unknown_cells",
     "\"box_hexes\"",
     "\"box_hexes\"\ncells = \"polyhedral\"",
     {"\"polyhedral\" is not a kind of cells; did you mean \"polyhedra\"?"}},
    {"slit_off_the_grid",
     "[[mesh.regions]]",
     "[[mesh.slits]]\nname = \"notch\"\nlower = [\"0.0123 mm\", \"-9 mm\", \"-9 mm\"]\n"
     "upper = [\"0.0123 mm\", \"9 mm\", \"9 mm\"]\n[[mesh.regions]]",
     {"slit \"notch\": x = 12.3 um is not a plane of the grid"}},
    {"slit_with_the_name_of_a_patch",
     "[[mesh.regions]]",
     "[[mesh.slits]]\nname = \"xmin\"\nlower = [\"0 mm\", \"-9 mm\", \"-9 mm\"]\n"
     "upper = [\"0 mm\", \"9 mm\", \"9 mm\"]\n[[mesh.regions]]",
     {"another patch has this name already"}},
    {"mesh_file_that_is_not_there",
     hexahedra_of_bar,
     "generator = \"vtk\"\nfile = \"data/no.vtu\"\nlength_unit = \"mm\"\n",
     {"case.toml:6: [mesh] file: cannot read ", "data/no.vtu: No such file or directory"}},
};

}  // namespace pfdm
