// Elasticity that depends on the direction in case files: its axes by material, region and place, and what is refused.

#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfdm::this_file {
namespace {

const std::string elasticity =
    "elasticity = { E1 = \"30 GPa\", E2 = \"3 GPa\", E3 = \"6 GPa\", nu12 = 0.0, nu13 = 0.0, nu23 = 0.0, "
    "G12 = \"2 GPa\", G13 = \"2 GPa\", G23 = \"2 GPa\" }\n";
const std::string across = "axes = { first = [0, 1, 0], second = [1, 0, 0] }\n";

std::string bar_with(const std::string& of_material) {
  return replaced(replaced(bar_case(), "young_modulus = \"30 GPa\"\n", ""), "poisson_ratio = 0.2\n", of_material);
}

// E of the bar along its length.
double modulus_of(const std::string& case_toml) {
  const TemporaryCase directory(case_toml);
  const Outcome outcome = run({"run", directory.path().string(), "--quiet", "--max-steps", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  return summary.at("initial_stiffness_N_per_m").get<double>() * 20e-3 / 1e-6;
}

TEST(Anisotropy, IsAlongTheAxesOfMaterialRegionAndPlace) {
  EXPECT_NEAR(modulus_of(bar_with(elasticity)) / 30e9, 1.0, 1e-9);
  EXPECT_NEAR(modulus_of(bar_with(elasticity + across)) / 3e9, 1.0, 1e-9);
  EXPECT_NEAR(
      modulus_of(bar_with(elasticity + "axes = { first = [{ expr = \"0*x\" }, 1, 0], second = [1, 0, 0] }\n")) / 3e9,
      1.0, 1e-9);
  // One cell of 21 is ten times as soft.
  EXPECT_NEAR(modulus_of(replaced(bar_with(elasticity), "[regions.weak]\n", "[regions.weak]\n" + across)) / 21e9, 1.0,
              1e-9);
  EXPECT_NEAR(modulus_of(bar_with("elasticity = { C11 = \"168 GPa\", C12 = \"121 GPa\", C44 = \"75 GPa\" }\n")) / 168e9,
              1.0, 1e-9);
}

class BadAnisotropy : public testing::TestWithParam<BadInput> {};

TEST_P(BadAnisotropy, IsRefused) {
  const TemporaryCase directory(replaced(bar_with(elasticity), GetParam().good, GetParam().bad));
  const Outcome outcome = run({"run", directory.path().string(), "--quiet", "--max-steps", "1"});
  EXPECT_EQ(outcome.status, 2);
  for (const std::string& part : GetParam().message)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    , BadAnisotropy,
    testing::Values(
        BadInput{"no_positive_energy",
                 "nu23 = 0.0",
                 "nu23 = 1.0",
                 {"elasticity: the elastic energy of these constants is not positive", "1 - nu23 nu32 = -1"}},
        BadInput{"with_young_modulus",
                 "G23 = \"2 GPa\" }\n",
                 "G23 = \"2 GPa\" }\nyoung_modulus = \"3 GPa\"\n",
                 {"young_modulus: the material has its elasticity already"}},
        BadInput{"parallel_axes",
                 "G23 = \"2 GPa\" }\n",
                 "G23 = \"2 GPa\" }\naxes = { first = [0, 1, 0], second = [0, 2, 0] }\n",
                 {"axes: the two axes must not be zero or parallel"}},
        BadInput{"tilted_out_of_the_plane",
                 "G23 = \"2 GPa\" }\n",
                 "G23 = \"2 GPa\" }\naxes = { first = [1, 0, 1], second = [0, 1, 0] }\n",
                 {"is not symmetric about the plane of a mesh one cell thick"}},
        BadInput{
            "split",
            "split = \"none\"",
            "split = \"spectral\"",
            {"region \"bar\": elasticity that depends on the direction cannot be combined with the energy split "
             "\"spectral\", which is one of isotropic elasticity; allowed: none, volumetric_deviatoric, orthogonal"}}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace pfdm::this_file
