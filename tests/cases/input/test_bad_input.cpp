// Whatever is wrong with the input ends with status 2 and one message that says what, where and what is allowed.

#include "postproc/files/folder_lock.h"
#include "tests/cases/input/bad_bodies.h"
#include "tests/cases/input/bad_loads.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

class BadCase : public testing::TestWithParam<BadInput> {};

TEST_P(BadCase, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(bar_case(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_words[] = {
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
    {"misspelt_required_key",
     "poisson_ratio",
     "poison_ratio",
     {"\"poison_ratio\" is not known here; did you mean \"poisson_ratio\"?"}},
    {"misspelt_optional_key",
     "maximum_increment",
     "maximal_increment",
     {"case.toml:44: [loading] \"maximal_increment\" is not known here; did you mean \"maximum_increment\"? (allowed: ",
      "initial_increment"}},
    {"perturbation_of_all",
     "length = \"4 mm\"",
     "length = \"4 mm\"\nperturbation = 0.6",
     {"[fracture] perturbation: 0.6 must be between 0 and 0.5"}},
    {"seed_without_a_perturbation",
     "length = \"4 mm\"",
     "length = \"4 mm\"\nperturbation_seed = 2",
     {"[fracture] perturbation_seed: this belongs to a perturbation, which is not given"}},
    {"misspelt_key_in_a_list", "frames_at", "frames_of", {"[output] \"frames_of\"", "did you mean \"frames_at\"?"}},
    {"unknown_table", "[loading]", "[load]", {"\"load\" is not known here"}},
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
    {"equilibrium_beyond_double_precision",
     "[output]",
     "[solver]\nequilibrium_tolerance = 1e-13\n[output]",
     {"[solver] equilibrium_tolerance: 1e-13 must be between 1e-12 and 1"}},
    {"unknown_linear_solver",
     "[output]",
     "[solver]\nlinear = \"lu\"\n[output]",
     {"[solver] linear: \"lu\" is not a linear solver", "automatic, multigrid, direct"}},
    {"no_toml", "[mesh]", "[mesh", {"case.toml:4:"}},
};

std::vector<BadInput> all_bad_inputs() {
  std::vector<BadInput> all(std::begin(bad_words), std::end(bad_words));
  all.insert(all.end(), std::begin(bad_bodies), std::end(bad_bodies));
  all.insert(all.end(), std::begin(bad_loads), std::end(bad_loads));
  return all;
}

INSTANTIATE_TEST_SUITE_P(Program, BadCase, testing::ValuesIn(all_bad_inputs()),
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
            "pfdm: unknown command \"rn\"; did you mean \"run\"? (available: run, check, mesh, cohesive, compare, "
            "reduce, fit, "
            "sweep, sensitivity, analyse, report, init, list, help, completion, test)\n");
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
