// What is wrong with a path of mean strain or stress is said in one message.

#include "tests/cases/parted_box.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

class BadPath : public testing::TestWithParam<BadInput> {};

TEST_P(BadPath, IsRefused) {
  const TemporaryCase directory(replaced(parted_box(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_inputs[] = {
    {"by_forces",
     "boundary = \"periodic\"",
     "boundary = \"uniform traction\"",
     {"[homogenization] boundary", "needs \"periodic\" or \"uniform displacement\""}},
    {"parted_and_held",
     "boundary = \"periodic\"",
     "boundary = \"uniform displacement\"",
     {"interface \"bond\" parts the box", "would hold it together", "take \"periodic\""}},
    {"unknown_component", "{ strain_zz = 0.05 }", "{ strain_zx = 0.05 }", {"\"strain_zx\" is not known here"}},
    {"without_unit", "{ strain_zz = 0.05 }", "{ strain_zz = 0.05, stress_xx = 3 }", {"stress_xx", "has no unit"}},
    {"percent_forgotten", "{ strain_zz = 0.05 }", "{ strain_zz = 6 }", {"strain_zz", "write \"6 %\""}},
    {"turned_inside_out", "{ strain_zz = 0.05 }", "{ strain_zz = \"-200 %\" }", {"strain_zz", "between -1 and 1"}},
    {"gamma_forgotten", "{ strain_zz = 0.05 }", "{ strain_zz = 0.05, gamma_xz = -2 }", {"gamma_xz", "write \"-2 %\""}},
    {"initial_without_fracture", "[loading]\n", "[initial]\ndamage = 0.5\n[loading]\n", {"initial", "[fracture]"}},
    {"from_a_fit",
     "\"50 MPa\"",
     "{ from = \"results/fit.json\", key = \"E_Pa\" }",
     {"there is no file results/fit.json", "has that been run, or fitted?"}},
    {"both", "{ strain_zz = 0.05 }", "{ strain_zz = 0.05, stress_zz = \"1 Pa\" }", {"stress or strain, not both"}},
    {"changes",
     "{ strain_zz = 0.05 }",
     "{ strain_xx = 0.05 }",
     {"every point has to prescribe the strain of the same components as the first"}},
    {"nothing", "{ strain_zz = \"15 %\" }, { strain_zz = 0.05 }", "{ strain_zz = 0 }", {"nothing is loaded"}},
    {"too_long", "[loading]\n", "[loading]\nend = 3\n", {"the path ends at the load parameter 2"}},
    {"release", "[loading]\n", "[loading]\nenergy_release = 0.1\n", {"energy_release", "a path of one point"}},
    {"snap_back", "[loading]\n", "[loading]\nmaximum_dissipation = \"1 uJ\"\n", {"requires a path of one point"}},
    {"frames", "[loading]\n", "[output]\nframes_at = [\"1 um\"]\n[loading]\n", {"give load parameters"}},
    {"patches",
     "[loading]\n",
     "[[boundary]]\npatch = \"zmin\"\ntype = \"symmetry\"\n[loading]\n",
     {"\"boundary\" is not known"}},
    {"toughness_without_fracture",
     "[[interface]]\n",
     "toughness = \"10 J/m^2\"\n[[interface]]\n",
     {"\"toughness\" is not known here"}},
};
INSTANTIATE_TEST_SUITE_P(All, BadPath, testing::ValuesIn(bad_inputs),
                         [](const auto& input) { return input.param.name; });

}  // namespace
}  // namespace pfdm::this_file
