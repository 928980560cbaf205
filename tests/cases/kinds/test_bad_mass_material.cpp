// What is wrong with cases of kind mass_material is said in one message.

#include "cases/program/input/case_files/case_file.h"
#include "tests/cases/soft_sample.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace pfdm::this_file {
namespace {

TEST(BadMassMaterial, ListsOfModels) {
  for (const auto& [keys, message] :
       {std::pair("models = []", "the list of models is empty"), std::pair("models = [\"1\", \"1\"]", "listed twice"),
        std::pair("structure = \"1\"\nmodels = [\"2\"]", "give one of them")}) {
    const TemporaryCase directory(soft_case() + keys + "\n");
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
}

class BadMassMaterial : public testing::TestWithParam<BadInput> {};

TEST_P(BadMassMaterial, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(soft_case(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_inputs[] = {
    {"gram_for_gravity", "\"2 g0\"", "\"2 g\"", {"[test.excitation] level", "write g0 for multiples of gravity"}},
    {"unknown_structure", "\"2\"", "\"8\"", {"[model] structure: \"8\" is not a mass-material model"}},
    {"stiffness_of_wrong_order", "\"-1.0e6 N/m^2\"", "\"-1.0e6 N/m^3\"", {"stiffness[1]", "stiffness of second order"}},
    {"negative_stiffness", "\"54 kN/m\"", "\"-54 kN/m\"", {"stiffness[0]: k_1 must be positive"}},
    {"exponent_without_term",
     "damping = \"40 N s/m\"",
     "damping = \"40 N s/m\"\ndamping_exponent = 1.8",
     {"damping_exponent: model \"2\" has none"}},
    {"kernel_without_term",
     "damping = \"40 N s/m\"",
     "damping = \"40 N s/m\"\nkernel = [{ alpha = \"1 s^-1\", beta = \"1 N/m\" }]",
     {"model \"2\" has no kernel"}},
    {"no_mass", "mass = \"1.12 kg\"\n", "", {"\"mass\" is missing"}},
    {"unknown_excitation", "level = \"2 g0\"", "tpye = 1, level = \"2 g0\"", {"\"tpye\" is not known here"}},
    {"sampled_too_slowly",
     "\"1 kHz\"",
     "\"150 Hz\"",
     {"the excitation reaches 70 Hz; 150 samples per second resolve up to 57 Hz"}},
    {"two_tests_of_one_name", "name = \"down\"", "name = \"up\"", {"there are two tests \"up\""}},
    {"names_of_one_file",
     "name = \"down\"",
     "name = \"up_spectra\"",
     {"the tests \"up\" and \"up_spectra\" would have results in files of the same name"}},
    {"name_that_is_no_file",
     "name = \"down\"",
     "name = \"a/b\"",
     {"is used as the name of files; it may have letters, digits"}},
    {"unknown_key_of_fit", "replicates", "replicate", {"[fit] \"replicate\"", "did you mean \"replicates\"?"}},
};
INSTANTIATE_TEST_SUITE_P(Program, BadMassMaterial, testing::ValuesIn(bad_inputs),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(BadMassMaterial, FitWithoutRecords) {
  const TemporaryCase directory(soft_case());
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("pfdm run simulates one"), std::string::npos) << outcome.err;
}

TEST(BadMassMaterial, ModelThatDoesNotCarry) {
  const std::string text = replaced(replaced(soft_case(), "\"2\"", "\"4a\""), "damping = \"40 N s/m\"",
                                    "damping = \"40 N s/m\"\nkernel = [{ alpha = \"1 s^-1\", beta = \"-9e4 N/m/s\" }]");
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("static stiffness"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
