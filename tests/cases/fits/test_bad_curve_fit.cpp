// What is wrong with [fit] is said in one message.

#include "postproc/files/csv_table.h"
#include "tests/cases/bar_fit.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace pfdm::this_file {
namespace {

class BadCurveFit : public testing::TestWithParam<BadInput> {};

TEST_P(BadCurveFit, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(bar_case() + bar_fit, GetParam().good, GetParam().bad));
  directory.write("data.csv", "displacement_m,force_N\n0,0\n1e-5,1\n");
  expect_refused(directory, GetParam());
}

const BadInput bad_fits[] = {
    {"key_that_is_not_there",
     "\"materials.concrete.young_modulus\"",
     "\"materials.concrete.young_modulos\"",
     {"[fit.parameters] key: [materials.concrete] has no \"young_modulos\" (available: regions, young_modulus"}},
    {"key_of_a_table",
     "\"materials.concrete.young_modulus\"",
     "\"materials.concrete\"",
     {"neither a quantity nor a number"}},
    {"key_of_a_word", "\"materials.concrete.young_modulus\"", "\"fracture.model\"", {"is not a quantity with a unit"}},
    {"key_named_twice",
     "key = [\"materials.concrete.toughness\",",
     "key = [\"materials.concrete.young_modulus\",",
     {"key[1]: this is an energy per area, \"materials.concrete.young_modulus\" is a stress"}},
    {"bounds_without_unit", "[\"10 GPa\", \"90 GPa\"]", "[10, 90]", {"bounds[0]: 10 has no unit; expected a stress"}},
    {"bounds_that_fall", "[\"10 GPa\", \"90 GPa\"]", "[\"90 GPa\", \"10 GPa\"]", {"must be below the upper one"}},
    {"misspelt_key", "bounds = [\"10", "bound = [\"10", {"did you mean \"bounds\"?"}},
    {"spread_of_zero", "[fit]\n", "[fit]\nspread = 0.0\n", {"[fit] spread: 0 must be above 0 and below 10"}},
    {"screened_points_below_zero",
     "[fit]\n",
     "[fit]\nscreened = -1\n",
     {"[fit] screened: -1 must be between 0 and 10000"}},
    {"more_starts_than_screened_points",
     "[fit]\n",
     "[fit]\nscreened = 2\nstarts = 3\n",
     {"[fit] starts: 3 descents cannot be chosen from 2 screened points"}},
    {"stage_with_more_starts_than_points",
     "[fit]\n",
     "[fit]\nstages = [{ name = \"a\", screened = 2, starts = 4 }]\n",
     {"[fit.stages] starts: 4 descents cannot be chosen from 2 screened points"}},
    {"unknown_differences",
     "[fit]\n",
     "[fit]\ndifferences = \"grid\"\n",
     {"\"grid\" is not a kind of differences (allowed: central, forward, shared)"}},
    {"step_of_zero", "[fit]\n", "[fit]\nstep = 0.0\n", {"[fit] step: 0 must be above 0 and below 0.5"}},
    {"stage_of_nothing",
     "[fit]\n",
     "[fit]\nstages = [{ name = \"a\", parameters = [] }]\n",
     {"a stage without parameters has nothing to estimate"}},
    {"compliance_without_first_guess",
     "[\"10 GPa\", \"90 GPa\"]\n",
     "[\"10 GPa\", \"90 GPa\"]\n[[fit.parameters]]\nkey = \"experiment.compliance\"\nbounds = [\"0 um/N\", \"1 "
     "um/N\"]\n",
     {"[experiment] has no \"compliance\""}},
    {"parameter_in_no_stage",
     "[fit]\n",
     "[fit]\nstages = [{ name = \"a\", parameters = [\"materials.concrete.young_modulus\"] }]\n",
     {"no stage estimates \"materials.concrete.toughness\""}},
};
INSTANTIATE_TEST_SUITE_P(Inputs, BadCurveFit, testing::ValuesIn(bad_fits),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(CurveFit, RefusesWhatCannotBeFitted) {
  const auto expect_in = [](const std::string& command, const std::string& good, const std::string& bad,
                            const std::string& message) {
    const TemporaryCase directory(replaced(bar_case() + bar_fit, good, bad));
    directory.write("data.csv", "displacement_m,force_N,s\n0,0,0\n1e-5,1,0\n");
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  const auto expect = [&](const std::string& good, const std::string& bad, const std::string& message) {
    expect_in("fit", good, bad, message);
  };
  expect("[\"10 GPa\", \"90 GPa\"]", "[\"40 GPa\", \"90 GPa\"]",
         "the case's own value, 30 GPa, from which the fit starts, is outside these bounds");
  expect("force = { column = \"force_N\" }", "force = { column = \"force_N\" }\ndeviation = { column = \"s\" }",
         "the standard deviation of \"one\" at 0 (SI), its point 1, is zero");
  expect_in("check", "force = { column = \"force_N\" }",
            "force = { column = \"force_N\" }\ndeviation = { column = \"s\" }",
            "the standard deviation of \"one\" at 0 (SI), its point 1, is zero");
  expect("bounds = [\"10 GPa\"", "prior = { mean = \"30 GPa\", deviation = \"1 GPa\" }\nbounds = [\"10 GPa\"",
         "a prior requires the noise of the data to be known");
}

// A run is not concerned; a fit would refuse it.
TEST(StartOfCurveFit, CheckWarnsOfAStartOutsideTheBounds) {
  const TemporaryCase directory(replaced(bar_case() + bar_fit, "[\"10 GPa\", \"90 GPa\"]", "[\"40 GPa\", \"90 GPa\"]"));
  directory.write("data.csv", "displacement_m,force_N\n0,0\n1e-5,1\n");
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("is outside these bounds; pfdm fit refuses this"), std::string::npos) << outcome.out;
}

TEST(CurveFit, ForcesOfTheOtherSignAreRefusedBeforeTheFit) {
  const BarFit fit(
      replaced(bar_fit, "force = { column = \"force_N\" }", "force = { column = \"force_N\", factor = -1 }"));
  const Outcome outcome = run({"fit", fit.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("the forces of \"one\" have the other sign than the computed ones of the first guess; "
                             "factor = 1 turns them"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
