// What is refused of a case of kind "homogenize".

#include "tests/cases/kinds/laminate.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

class BadHomogenization : public testing::TestWithParam<BadInput> {};

TEST_P(BadHomogenization, IsRefused) {
  const TemporaryCase directory(replaced(laminate(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_inputs[] = {
    {"unknown_boundary",
     "boundary = \"periodic\"",
     "boundary = \"periodik\"",
     {"[homogenization] boundary: \"periodik\" is not", "did you mean \"periodic\"?"}},
    {"damage",
     "loss_factor = 0.2",
     "toughness = \"10 J/m^2\"",
     {"[materials.rubber] \"toughness\" is not known here", "it goes with [homogenization] path"}},
    {"expansion",
     "loss_factor = 0.2",
     "expansion = \"1e-5 1/K\"",
     {"[materials.rubber] expansion: a box that follows its mean strain has no temperature"}},
    {"negative_loss", "loss_factor = 0.2", "loss_factor = -0.1", {"must be zero or positive"}},
    {"other_table",
     "[solver]",
     "[fracture]\nsplit = \"none\"\n[solver]",
     {"\"fracture\" is not known here", "it goes with [homogenization] path"}},
    {"interface",
     "[solver]",
     "[[interface]]\nname = \"bond\"\n[solver]",
     {"\"interface\" is not known here", "it goes with [homogenization] path"}},
    {"no_key_of_any", "[solver]", "[solvent]\n[solver]", {"did you mean \"solver\"?"}},
    {"no_such_region", "regions = [\"stiff\"]", "regions = [\"hard\"]", {"\"hard\" is not a region of the mesh"}},
    {"no_density", "density = \"1000 kg/m^3\"", "density = 1000", {"[materials.rubber] density", "has no unit"}},
    {"not_a_box",
     "region = \"soft\"\n",
     "region = \"soft\"\nholes = [{ name = \"bite\", lower = [\"0 mm\", \"0 mm\", \"0 mm\"], upper = [\"0.5 mm\", \"1 "
     "mm\", \"0.5 mm\"] }]\n",
     {"cover", "% of that side of the box"}},
};
INSTANTIATE_TEST_SUITE_P(All, BadHomogenization, testing::ValuesIn(bad_inputs),
                         [](const auto& input) { return input.param.name; });

}  // namespace
}  // namespace pfdm::this_file
