// What is wrong with [fit] of a case of kind "endochronic" is said in one message.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_case.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_fit.h"
#include "tests/cases/temporary_case.h"
#include "tests/solver/independent_simulators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

struct BadFit {
  const char* name;
  const char* good;
  const char* bad;
  const char* message;
};
void PrintTo(const BadFit& input, std::ostream* stream) { *stream << input.name; }

class BadFitCase : public testing::TestWithParam<BadFit> {};

TEST_P(BadFitCase, IsRefusedWithOneMessage) {
  const FitCase fit(replaced(fit_table, GetParam().good, GetParam().bad));
  const Outcome outcome = run({"fit", fit.directory.path().string()});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("case.toml:"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(fit.directory.results()));
}

const BadFit bad_fits[] = {
    {"unknown_method", "\"joint\"", "\"join\"", "is not a method of identification; did you mean \"joint\"?"},
    {"unknown_part", "\"hardening\"]", "\"softening\"]",
     "\"softening\" is not a part of the law that can be estimated"},
    {"bound_of_no_parameter", "f_inf = [0.5, 10]", "f_0 = [0.5, 10]", "\"f_0\" is not estimated (available: C_1"},
    {"bounds_that_cross", "[0.5, 10]", "[10, 0.5]", "the lower bound must be below the upper one"},
    {"terms", "method = \"joint\"", "method = \"joint\"\nterms = [3, 2]", "the first number of terms is larger"},
    {"no_experiments", "[[fit.experiments]]", "[[fit.experiment]]", "did you mean \"experiments\"?"},
    {"names_with_the_same_file", "[[fit.experiments]]",
     "[[fit.experiments]]\nname = \"cycles 0_5 %\"\ncsv = \"cycles.csv\"\nstrain = { strain_xx = { column = "
     "\"strain_xx\" } "
     "}\nstress = { stress_xx = { column = \"stress_xx_Pa\" } }\n[[fit.experiments]]",
     "name: the curves of \"cycles 0_5 %\" and \"cycles 0.5 %\" would have the same file, fit_cycles_0_5__.csv"},
    {"stress_of_a_test_at_given_stress", "csv = \"cycles.csv\"", "csv = \"cycles.csv\"\ncontrolled = \"stress\"",
     "at least one of [[fit.experiments]] is required that is not predicted and has measured stresses"},
    {"no_file", "\"cycles.csv\"", "\"circles.csv\"", "csv: cannot read"},
    {"no_column", "column = \"stress_xx_Pa\"", "column = \"stress\"", "there is no column \"stress\""},
    {"unit", "unit = \"Pa\"", "unit = \"mm\"", "expected a stress"},
    {"strain_as_stress", "stress = { stress_xx", "stress = { strain_xx", "expected a stress; strains belong in"},
    {"stress_as_strain", "strain = { strain_xx", "strain = { stress_xx", "expected a strain; stresses belong in"},
    {"stress_without_its_strain", "stress = { stress_xx", "stress = { stress_xy",
     "stress_xy was measured, but [fit.experiments.strain] does not name its strain"},
    {"followed_twice", "strain = { strain_xx",
     "strain = { strain_xy = { column = \"strain_xy\" }, gamma_xy = { column = \"strain_xy\" }, strain_xx",
     "the component xy is given twice"},
    {"measured_twice", "csv = \"cycles.csv\"\nstrain = { strain_xx = { column = \"strain_xx\" } }\nstress = {",
     "csv = \"cycles.csv\"\ncontrolled = \"stress\"\nstrain = { gamma_xy = { column = \"strain_xy\" }, strain_xy = { "
     "column "
     "= \"strain_xy\" } }\nstress = {",
     "the component xy is given twice"},
    {"noise_without_the_columns_unit",
     "csv = \"cycles.csv\"\nstrain = { strain_xx = { column = \"strain_xx\" } }\nstress = {",
     "csv = \"cycles.csv\"\ncontrolled = \"stress\"\nstrain = { strain_xx = { column = \"strain_xx\", unit = \"%\", "
     "noise = "
     "0.01 } }\nstress = {",
     "the noise needs one too, as \"0.01 %\""},
    {"noise_of_some",
     "strain = { strain_xx = { column = \"strain_xx\" } }\nstress = { stress_xx = { column = \"stress_xx_Pa\", unit = "
     "\"Pa\" } }",
     "strain = { strain_xx = { column = \"strain_xx\" }, strain_xy = { column = \"strain_xy\" } }\nstress = { "
     "stress_xx = "
     "{ column = \"stress_xx_Pa\", noise = \"1 MPa\" }, stress_xy = { column = \"stress_xy_Pa\" } }",
     "noise is given for 1 of 2 measured curves"},
};

INSTANTIATE_TEST_SUITE_P(EndochronicProgram, BadFitCase, testing::ValuesIn(bad_fits),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace pfdm::this_file
