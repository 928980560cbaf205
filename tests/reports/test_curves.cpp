// Measured curves as machines and authors leave them.

#include "tests/reports/reported_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The estimate of the case's first parameter, of a fit that ended with this verdict.
double fitted(const ReportedCase& reported, const std::string& verdict) {
  const Outcome fit = reported.run("fit");
  EXPECT_EQ(fit.status, 0) << fit.err;
  const auto json = reported.json("fit.json");
  EXPECT_EQ(json["verdict"], verdict) << fit.out;
  return json["parameters"][0]["estimate"];
}

void replace_in_case(const ReportedCase& reported, const std::string& old, const std::string& by) {
  std::string text = content_of(reported.path() / "case.toml");
  ASSERT_NE(text.find(old), std::string::npos);
  text.replace(text.find(old), old.size(), by);
  std::ofstream(reported.path() / "case.toml") << text;
}

class MachineExport : public ::testing::TestWithParam<const char*> {};

// Young's modulus is 70 GPa; the grips slip by 6 um, the noise is 1 N.
TEST_P(MachineExport, GivesItsModulus) {
  const ReportedCase reported(std::string("12_machine_exports/") + GetParam());
  const double modulus = fitted(reported, "sound");
  EXPECT_GT(modulus, 69.9e9);
  EXPECT_LT(modulus, 70.0e9);
}

INSTANTIATE_TEST_SUITE_P(Layouts, MachineExport,
                         ::testing::Values("bluehill", "mts793", "shimadzu", "zwick_german_latin1"));

TEST(ReportedCurves, MayHaveTheirThousandsApart) {
  const ReportedCase reported("12_machine_exports/thousands");
  EXPECT_THAT(reported.run("check").err, HasSubstr("if its thousands are apart, set thousands = \".\""));
  replace_in_case(reported, "csv = ", "thousands = \".\"\ncsv = ");
  const double modulus = fitted(reported, "sound");
  EXPECT_GT(modulus, 69.9e9);
  EXPECT_LT(modulus, 70.0e9);
}

// E = F/u L/A of rows that all lie on one line.
TEST(ReportedCurves, MayHaveTextOrNothingInOtherColumns) {
  for (const char* folder : {"text", "empty"}) {
    const ReportedCase reported(std::string("13_text_and_empty_cells/") + folder);
    EXPECT_THAT(reported.run("check").out, Not(HasSubstr("left out"))) << folder;
    EXPECT_EQ(reported.run("fit").status, 0) << folder;
    EXPECT_NEAR(reported.json("fit.json")["parameters"][0]["estimate"].get<double>(), 70e9, 7e6) << folder;
  }
}

TEST(ReportedCurves, LoseRowsWithoutAValueThatIsUsed) {
  const ReportedCase reported("13_text_and_empty_cells/empty");
  std::ofstream(reported.path() / "r.csv") << "u_mm,F_N,exx\n0,0,\n0.005,,\n0.01,168,\n,200,\n0.02,336,\n0.03,504,\n";
  const Outcome fit = reported.run("fit");
  EXPECT_THAT(fit.out, HasSubstr("csv: 2 of 6 rows left out: an entry of a column that is used is empty"));
  EXPECT_THAT(fit.out.substr(fit.out.find("rows left out") + 1), Not(HasSubstr("rows left out")));
  EXPECT_NEAR(reported.json("fit.json")["parameters"][0]["estimate"].get<double>(), 70e9, 7e6);
}

// Half of the force and twice the displacement: a quarter of the modulus.
TEST(ReportedCurves, MayBeMultipliedByAFactor) {
  const ReportedCase reported("13_text_and_empty_cells/text");
  replace_in_case(reported, "column = \"u_mm\"", "column = \"u_mm\", factor = 2");
  replace_in_case(reported, "column = \"F_N\"", "column = \"F_N\", factor = 0.5");
  EXPECT_EQ(reported.run("fit").status, 0);
  EXPECT_NEAR(reported.json("fit.json")["parameters"][0]["estimate"].get<double>(), 17.5e9, 2e6);
  replace_in_case(reported, "factor = 0.5", "factor = 0");
  const Outcome zero = reported.run("check");
  EXPECT_EQ(zero.status, 2);
  EXPECT_THAT(zero.err, HasSubstr("factor: it must not be zero"));
}

TEST(ReportedCurves, ArePublishedWithNamesOfSpecimensAndWithoutNamesOfColumns) {
  for (const char* folder : {"13_text_and_empty_cells/epfl_dcb_as_published", "16_no_header"}) {
    const Outcome check = ReportedCase(folder).run("check");
    EXPECT_EQ(check.status, 0) << check.err;
    EXPECT_THAT(check.out, HasSubstr("the input is valid"));
  }
}

// The law has no rates, so that rows a second apart and rows without times are the same test.
TEST(ReportedCurves, NeedNoTimesForALawWithoutRates) {
  const ReportedCase with_times("24_cyclic_steel"), without("24_cyclic_steel/as_published");
  const double modulus = fitted(with_times, "questionable");
  EXPECT_NEAR(fitted(without, "questionable"), modulus, 1e-4 * modulus);
  EXPECT_THAT(content_of(without.results() / "fit.json"), HasSubstr("stands for an elastic range"));
  EXPECT_THAT(without.run("check").out, HasSubstr("it has no times: its rows are taken in their order"));
  replace_in_case(without, "[fit]\n",
                  "[material.rate]\nlaw = \"power\"\nm = 0.1\nreference_rate = \"1 s^-1\"\n\n[fit]\n");
  EXPECT_THAT(without.run("check").err, HasSubstr("the law depends on the rate, so the times are needed"));
}

}  // namespace
}  // namespace pfdm::this_file
