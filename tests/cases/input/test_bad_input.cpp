// Whatever is wrong with the input ends with status 2 and one message that says what, where and what is allowed.

#include "postproc/files/folder_lock.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pfdm::this_file {
namespace {

class BadCase : public testing::TestWithParam<BadInput> {};

TEST_P(BadCase, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(bar_case(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

constexpr const char* hexahedra_of_bar = R"(generator = "box_hexes"
x = [{ length = "20 mm", cells = 21 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 1 }]
region = "bar"
[[mesh.regions]]
name = "weak"
lower = ["9.6 mm", "-1 mm", "-1 mm"]
upper = ["10.4 mm", "2 mm", "2 mm"]
)";

const BadInput bad_inputs[] = {
    {"unit_of_another_dimension",
     "\"30 GPa\"",
     "\"30 um\"",
     {"case.toml:17: [materials.concrete] young_modulus: \"30 um\" is a length; expected a stress, as in \"75 MPa\""}},
    {"no_unit",
     "length = \"4 mm\"",
     "length = 4",
     {"case.toml:27: [fracture] length: 4 has no unit; expected a length"}},
    {"unknown_unit", "\"4 mm\"", "\"4 furlong_\"", {"the unit \"furlong_\" is not known"}},
    {"missing_key", "poisson_ratio = 0.2\n", "", {"case.toml:15: [materials.concrete] \"poisson_ratio\" is missing"}},
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
    {"pressure_where_nothing_is_free",
     "displacement = [\"0 mm\", \"free\", \"free\"]",
     "displacement = [\"0 mm\", \"0 mm\", \"0 mm\"]\npressure = \"1 MPa\"",
     {"[boundary] pressure: all components of the displacement are prescribed, which leaves none for a pressure"}},
    {"pressure_on_a_plane_of_symmetry",
     "type = \"symmetry\"",
     "type = \"symmetry\"\npressure = \"1 MPa\"",
     {"[boundary] pressure: a patch of type \"symmetry\" takes no prescribed value"}},
    {"foundation_without_stiffness",
     "type = \"symmetry\"",
     "type = \"elastic_foundation\"",
     {"[boundary] an elastic foundation has a normal_stiffness or a tangential_stiffness above 0, or both"}},
    {"foundation_of_no_stiffness_at_all",
     "type = \"symmetry\"",
     "type = \"elastic_foundation\"\nnormal_stiffness = \"0 N/m^3\"",
     {"[boundary] an elastic foundation has a normal_stiffness or a tangential_stiffness above 0, or both"}},
    {"foundation_of_negative_stiffness",
     "type = \"symmetry\"",
     "type = \"elastic_foundation\"\ntangential_stiffness = \"-1 MN/m^3\"",
     {"[boundary] tangential_stiffness: \"-1 MN/m^3\" must be zero or positive"}},
    {"foundation_of_negative_stiffness_somewhere",
     "type = \"symmetry\"",
     "type = \"elastic_foundation\"\nnormal_stiffness = { expr = \"1 - 1e6*x\", unit = \"MN/m^3\" }",
     {"[boundary] normal_stiffness: ", ") m must be zero or positive"}},
    {"foundation_with_a_pressure",
     "type = \"symmetry\"",
     "type = \"elastic_foundation\"\nnormal_stiffness = \"1 MN/m^3\"\npressure = \"1 MPa\"",
     {"[boundary] pressure: a patch of type \"elastic_foundation\" takes no prescribed value"}},
    {"foundation_on_a_plane_of_symmetry",
     "type = \"symmetry\"",
     "type = \"symmetry\"\nnormal_stiffness = \"1 MN/m^3\"",
     {"[boundary] \"normal_stiffness\" is not known here"}},
    {"foundation_on_the_front_of_a_plane_mesh",
     "type = \"plane\"",
     "type = \"plane\"\nnormal_stiffness = \"1 MN/m^3\"",
     {"[boundary] \"normal_stiffness\" is not known here"}},
    {"pressure_that_is_no_stress",
     "[\"0.015 mm\", \"free\", \"free\"]",
     "[\"free\", \"free\", \"free\"]\npressure = \"1 N\"",
     {"[boundary] pressure: \"1 N\" is a force; expected a stress"}},
    {"pressure_without_a_value",
     "[\"0.015 mm\", \"free\", \"free\"]",
     "[\"0.015 mm\", \"free\", \"free\"]\npressure = { expr = \"1/0\", unit = \"MPa\" }",
     {"[boundary] pressure"}},
    {"dissipation_with_a_pressure_that_is_not_proportional",
     "patches = [\"ymin\", \"ymax\"]\ntype = \"symmetry\"\n[[boundary]]\npatches = [\"zmin\", \"zmax\"]\ntype = "
     "\"plane\"\n\n[loading]\ninitial_increment = 0.1\nmaximum_increment = 0.1\n\n[output]\ncurve = { patch = "
     "\"xmax\", "
     "component = \"x\" }\nframes_at = [\"0.006 mm\"]",
     "patch = \"ymin\"\ntype = \"symmetry\"\n[[boundary]]\npatch = \"ymax\"\npressure = { expr = \"t^2\", unit = "
     "\"MPa\" }\n[[boundary]]\npatches = [\"zmin\", "
     "\"zmax\"]\ntype = \"plane\"\n[loading]\ninitial_increment = 0.1\nmaximum_dissipation = \"2 uJ\"\n[output]\ncurve "
     "= { "
     "patch = \"xmax\", component = \"x\" }\n",
     {"requires boundary values proportional to t; those of patch \"ymax\" are not"}},
    {"front_without_a_back",
     "patches = [\"zmin\", \"zmax\"]\ntype = \"plane\"",
     "patch = \"zmin\"\ntype = \"plane\"",
     {"are for both sides, front and back, of a mesh that is one cell thick", "has one of them"}},
    {"plane_stress_behind_plane_strain",
     "patches = [\"zmin\", \"zmax\"]\ntype = \"plane\"",
     "patch = \"zmin\"\ntype = \"plane\"\n[[boundary]]\npatch = \"zmax\"\ntype = \"plane_stress\"",
     {"patch \"zmax\" is of type \"plane_stress\"", "one type: \"plane\" (plane strain) or \"plane_stress\""}},
    {"missing_table",
     "[fracture]",
     "[[boundary]]\n[[boundary.x]]",
     {"\"fracture\" is missing; expected a table [fracture]"}},
    {"misspelt_required_key",
     "poisson_ratio",
     "poison_ratio",
     {"\"poison_ratio\" is not known here; did you mean \"poisson_ratio\"?"}},
    {"misspelt_optional_key",
     "maximum_increment",
     "maximal_increment",
     {"case.toml:44: [loading] \"maximal_increment\" is not known here; did you mean \"maximum_increment\"? (allowed: ",
      "initial_increment"}},
    {"dissipation_with_frames_at_loads",
     "maximum_increment = 0.1",
     "maximum_increment = 0.1\nmaximum_dissipation = \"2 uJ\"",
     {"[output] frames_at: with loading.maximum_dissipation the load may pass a value more than once; use "
      "frames_every"}},
    {"dissipation_that_is_no_energy",
     "maximum_increment = 0.1",
     "maximum_increment = 0.1\nmaximum_dissipation = \"2 um\"",
     {"[loading] maximum_dissipation: \"2 um\" is a length; expected an energy"}},
    {"viscosity_without_time",
     "length = \"4 mm\"",
     "length = \"4 mm\"\nviscosity = \"1 kPa s\"",
     {"[loading] fracture.viscosity requires the time in which the load parameter grows by 1"}},
    {"perturbation_of_all",
     "length = \"4 mm\"",
     "length = \"4 mm\"\nperturbation = 0.6",
     {"[fracture] perturbation: 0.6 must be between 0 and 0.5"}},
    {"seed_without_a_perturbation",
     "length = \"4 mm\"",
     "length = \"4 mm\"\nperturbation_seed = 2",
     {"[fracture] perturbation_seed: this belongs to a perturbation, which is not given"}},
    {"viscosity_that_is_no_viscosity",
     "length = \"4 mm\"",
     "length = \"4 mm\"\nviscosity = \"1 s\"",
     {"[fracture] viscosity: \"1 s\" is a time; expected a viscosity, as in \"1 kPa s\""}},
    {"misspelt_key_in_a_list", "frames_at", "frames_of", {"[output] \"frames_of\"", "did you mean \"frames_at\"?"}},
    {"unknown_table", "[loading]", "[load]", {"\"load\" is not known here"}},
    {"patch_that_is_not_there",
     "patch = \"xmin\"",
     "patch = \"xmim\"",
     {"case.toml:30: [boundary] patch: \"xmim\" is not a patch of the mesh; did you mean \"xmin\"? (allowed: xmin, "
      "xmax,"}},
    {"patch_of_the_curve",
     "curve = { patch = \"xmax\"",
     "curve = { patch = \"top\"",
     {"case.toml:47: [output.curve] patch: \"top\" is not a patch of the mesh"}},
    {"initial_damage_in_a_region_that_is_not_there",
     "[fracture]",
     "[initial]\ndamage = 1.0\nregions = [\"weka\"]\n[fracture]",
     {"[initial] regions[0]: \"weka\" is not a region of the mesh; did you mean \"weak\"?"}},
    {"initial_damage_in_no_region",
     "[fracture]",
     "[initial]\ndamage = 1.0\nregions = []\n[fracture]",
     {"[initial] regions: the list is empty"}},
    {"patch_named_twice",
     "[\"ymin\", \"ymax\"",
     "[\"xmin\", \"ymax\"",
     {"patch \"xmin\" already has a boundary condition"}},
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
    {"ring_without_width",
     "frames_at = [\"0.006 mm\"]",
     "[[output.energy_release_rate]]\nname = \"tip\"\npoint = [\"1 mm\", \"0 mm\", \"0 mm\"]\ndirection = [1, 0, 0]\n"
     "inner = \"2 mm\"\nouter = \"1 mm\"",
     {"outer: it must be larger than inner"}},
    {"front_along_the_growth",
     "frames_at = [\"0.006 mm\"]",
     "[[output.energy_release_rate]]\nname = \"tip\"\npoint = [\"1 mm\", \"0 mm\", \"0 mm\"]\ndirection = [0, 1, 1]\n"
     "inner = \"1 mm\"\nouter = \"2 mm\"",
     {"must be perpendicular to direction"}},
    {"threshold_of_a_fixed_tip",
     "frames_at = [\"0.006 mm\"]",
     "[[output.energy_release_rate]]\nname = \"tip\"\npoint = [\"1 mm\", \"0 mm\", \"0 mm\"]\ndirection = [1, 0, 0]\n"
     "inner = \"1 mm\"\nouter = \"2 mm\"\ntip_damage = 0.5",
     {"this requires tip = \"foremost\""}},
    {"ring_between_the_faces",
     "frames_at = [\"0.006 mm\"]",
     "[[output.energy_release_rate]]\nname = \"tip\"\npoint = [\"10 mm\", \"0.5 mm\", \"0.5 mm\"]\n"
     "direction = [1, 0, 0]\ninner = \"1 nm\"\nouter = \"2 nm\"",
     {"region \"tip\": no face of the mesh has its centre in the ring"}},
    {"title_of_two_lines", "\"a bar\"", "\"a\\nbar\"", {"case.toml:2: title: expected a text of one line"}},
    {"all_of_the_stiffness_left",
     "split = \"none\"",
     "split = \"none\"\nresidual_stiffness = 1",
     {"residual_stiffness: 1 must be above 0 and below 1"}},
    {"unknown_generator", "\"box_hexes\"", "\"box_hexe\"", {"is not a mesh generator; did you mean \"box_hexes\"?"}},
    {"polyhedra_of_hexahedra",
     "\"box_hexes\"",
     "\"box_hexes\"\ncells = \"polyhedra\"",
     {"case.toml:4: [mesh]", "polyhedra are made of tetrahedra, wedges and pyramids; 42 of the mesh's 42 cells"}},
    {"unknown_cells",
     "\"box_hexes\"",
     "\"box_hexes\"\ncells = \"polyhedral\"",
     {"\"polyhedral\" is not a kind of cells; did you mean \"polyhedra\"?"}},
    {"unknown_kind",
     "\"fracture\"",
     "\"fractal\"",
     {"case.toml:1: kind: \"fractal\" is not a kind of case", "fracture"}},
    {"unknown_model", "\"AT1\"", "\"AT3\"", {"is not a crack geometric function", "AT1", "AT2"}},
    {"strength_model_without_strength",
     "model = \"AT1\"",
     "model = \"strength\"",
     {"region \"bar\" can be damaged but has no strength (in uniaxial tension), which the model of strength needs"}},
    {"strength_model_with_history",
     "model = \"AT1\"",
     "model = \"strength\"\nirreversibility = \"history\"",
     {"[fracture] irreversibility: the model \"strength\" requires \"bounds\" or \"crack_set\""}},
    {"strength_model_with_another_degradation",
     "model = \"AT1\"",
     "model = \"strength\"\ndegradation = \"cubic\"",
     {"[fracture] degradation: the model \"strength\" requires the degradation \"quadratic\""}},
    {"delta_without_a_strength_model",
     "model = \"AT1\"",
     "model = \"AT1\"\ndelta = 1.5",
     {"[fracture] delta: this belongs to the model \"strength\""}},
    {"cohesive_crack_without_strength",
     "model = \"AT1\"",
     "model = \"Wu\"\ndegradation = \"rational\"",
     {"region \"bar\" can be damaged but has no strength (ft), which the softening law \"linear\" needs"}},
    {"unknown_softening_law",
     "model = \"AT1\"",
     "model = \"Wu\"\ndegradation = \"rational\"\nsoftening = \"bilinear\"",
     {"is not a softening law", "linear, exponential, hyperbolic, cornelissen"}},
    {"bad_expression",
     "\"0.015 mm\"",
     "{ expr = \"0.1*q\", unit = \"mm\" }",
     {"case.toml:34:", "the expression \"0.1*q\" cannot be read", "x, y, z"}},
    {"expression_with_wrong_unit",
     "\"0.015 mm\"",
     "{ expr = \"0.1*t\", unit = \"kg\" }",
     {"is a mass; expected a length"}},
    {"expression_without_unit", "\"0.015 mm\"", "{ expr = \"0.1*t\" }", {"\"unit\" is missing"}},
    {"wrong_number_of_components",
     "[\"0 mm\", \"free\", \"free\"]",
     "[\"0 mm\", \"free\"]",
     {"expected 3 entries, found 2"}},
    {"displacement_and_traction",
     "displacement = [\"0 mm\", \"free\", \"free\"]",
     "displacement = [\"0 mm\", \"free\", \"free\"]\ntraction = [\"1 Pa\", \"free\", \"free\"]",
     {"this component's displacement is prescribed as well"}},
    {"frame_beyond_the_end",
     "\"0.006 mm\"",
     "\"0.06 mm\"",
     {"this is at load parameter 4; the loading goes from 0 to 1"}},
    {"increments_that_fall",
     "initial_increment = 0.1",
     "initial_increment = 0.2",
     {"expected minimum <= initial <= maximum of the increments"}},
    {"damage_that_grows_beyond_one",
     "initial_increment = 0.1",
     "damage_growth = 1.5\ninitial_increment = 0.1",
     {"[loading] damage_growth: 1.5", "above 0 and at most 1"}},
    {"equilibrium_beyond_double_precision",
     "[output]",
     "[solver]\nequilibrium_tolerance = 1e-13\n[output]",
     {"[solver] equilibrium_tolerance: 1e-13 must be between 1e-12 and 1"}},
    {"unknown_linear_solver",
     "[output]",
     "[solver]\nlinear = \"lu\"\n[output]",
     {"[solver] linear: \"lu\" is not a linear solver", "automatic, multigrid, direct"}},
    {"no_energy_to_be_released",
     "initial_increment = 0.1",
     "energy_release = 0\ninitial_increment = 0.1",
     {"[loading] energy_release: 0", "above 0 and at most 1"}},
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
    {"unknown_type",
     "displacement = [\"0 mm\", \"free\", \"free\"]",
     "type = \"fre\"",
     {"is not a type of boundary condition; did you mean \"free\"?"}},
    {"no_toml", "[mesh]", "[mesh", {"case.toml:4:"}},
    {"mesh_file_that_is_not_there",
     hexahedra_of_bar,
     "generator = \"vtk\"\nfile = \"data/no.vtu\"\nlength_unit = \"mm\"\n",
     {"case.toml:6: [mesh] file: cannot read ", "data/no.vtu: No such file or directory"}},
};

INSTANTIATE_TEST_SUITE_P(Program, BadCase, testing::ValuesIn(bad_inputs),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(BadInput, MeshFileThatCannotBeRead) {
  const TemporaryCase directory(replaced(bar_case(), "generator = \"box_hexes\"\n",
                                         "generator = \"vtk\"\nfile = \"m.vtu\"\nlength_unit = \"mm\"\n"));
  directory.write("m.vtu", "this is no mesh");
  directory.write("case.toml", [&] {
    std::string text = content_of(directory.path() / "case.toml");
    const std::size_t first = text.find("x = ");
    return text.erase(first, text.find("[materials") - first);
  }());
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("m.vtu"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("case.toml:4: [mesh]"), std::string::npos) << outcome.err;
}

TEST(BadInput, LengthThatTheStrengthDoesNotAllow) {
  const std::string cohesive = replaced(bar_case(), "model = \"AT1\"", "model = \"Wu\"\ndegradation = \"rational\"");
  const TemporaryCase directory(
      replaced(cohesive, "poisson_ratio = 0.2\n", "poisson_ratio = 0.2\nstrength = \"40 MPa\"\n"));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("the length (ell) is 4 mm; with this strength and toughness the \"linear\" law needs one "
                             "of at most 1.19"),
            std::string::npos)
      << outcome.err;
}

void expect_no_path(const std::string& good, const std::string& bad, const std::string& message) {
  std::string text = replaced(bar_case(), "frames_at = [\"0.006 mm\"]", "");
  text = replaced(text, "maximum_increment = 0.1", "maximum_increment = 0.1\nmaximum_dissipation = \"2 uJ\"");
  const TemporaryCase directory(replaced(text, good, bad));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
}

TEST(BadInput, DissipationWhereItCannotBePrescribed) {
  expect_no_path("\"0.015 mm\"", "{ expr = \"0.015*t^2\", unit = \"mm\" }", "those of patch \"xmax\" are not");
  expect_no_path("split = \"none\"", "split = \"none\"\nirreversibility = \"history\"",
                 "dissipation control (loading.maximum_dissipation) requires the irreversibility \"bounds\"");
}

TEST(BadInput, CaseThatIsNotThere) {
  const Outcome outcome = run({"run", "no/such/case"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "pfdm: no/such/case: there is no such case directory\n");
}

TEST(BadInput, WrongUsage) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {}, {"rum", "case"}, {"run"}, {"run", "x", "--threads", "0"}, {"run", "x", "--no-such-option"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_FALSE(outcome.err.empty());
  }
}

TEST(BadInput, ResultsFolderWithoutAName) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"run", directory.path().string(), "--output", ""});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("--output: a value is required"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(directory.results()));
}

TEST(BadInput, UnknownCommand) {
  EXPECT_EQ(run({"rn", "case"}).err,
            "pfdm: unknown command \"rn\"; did you mean \"run\"? (available: run, check, mesh, cohesive, compare, fit, "
            "sweep, analyse, report, init, list, help, completion, test)\n");
}

TEST(BadInput, JobThatTheKindOfCaseDoesNotHave) {
  const Outcome outcome = run({"cohesive", PFDM_CASES_DIR "/endochronic_uniaxial"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("this kind of case has no \"cohesive\""), std::string::npos) << outcome.err;
}

TEST(BadInput, ResultsThatCannotBeWritten) {
  const TemporaryCase directory(bar_case());
  directory.write("file", "");
  const Outcome outcome =
      run({"run", directory.path().string(), "--output", (directory.path() / "file/results").string()});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("file/results"), std::string::npos) << outcome.err;
}

TEST(BadInput, ResultsThatAnotherRunIsWriting) {
  const TemporaryCase directory(bar_case());
  const FolderLock other(directory.path() / "results");
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("another run"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
