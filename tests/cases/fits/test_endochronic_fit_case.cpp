// pfdm fit on cases of kind "endochronic", with data that the program made itself.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_case.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"
#include "tests/solver/independent_simulators.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

std::string cyclic_case(const std::string& kernel, const std::string& f_inf) {
  return "kind = \"endochronic\"\ntitle = \"cycles\"\n[material]\nyoung_modulus = \"100 GPa\"\npoisson_ratio = 0.3\n" +
         kernel + "[material.hardening]\nlaw = \"saturating\"\nf_inf = " + f_inf + R"x(
b = 20.0

[loading]
[[loading.segments]]
duration = "3 s"
increments = 90
control = { strain_xx = { expr = "0.005*sin(2*pi*t)", unit = "1" } }
)x";
}

const std::string true_kernel = "kernel = [{ C = \"30 GPa\", alpha = 700 }, { C = \"4 GPa\", alpha = 60 }]\n";
const std::string first_kernel_guess = R"(kernel = [
  { C = "20 GPa", alpha = 1000 },
  { C = "6 GPa", alpha = 40 },
]
)";

const std::string fit_table = R"(
[fit]
method = "joint"
estimate = ["kernel", "hardening"]
[fit.bounds]
f_inf = [0.5, 10]
C_1 = ["1 GPa", "500 GPa"]
[[fit.experiments]]
name = "cycles 0.5 %"
csv = "cycles.csv"
strain = { strain_xx = { column = "strain_xx" } }
stress = { stress_xx = { column = "stress_xx_Pa", unit = "Pa" } }
)";

/// A case to be fitted and the history of the true law in cycles.csv.
class FitCase {
 public:
  explicit FitCase(const std::string& fit = fit_table) : directory(cyclic_case(true_kernel, "2.0")) {
    if (run({"run", directory.path().string(), "--quiet"}).status != 0) throw std::logic_error("the true law fails");
    directory.write("cycles.csv", "# synthetic\n" + content_of(directory.results() / "history.csv"));
    std::filesystem::remove_all(directory.results());
    directory.write("case.toml", cyclic_case(first_kernel_guess, "1.5") + fit);
  }
  TemporaryCase directory;
};

TEST(EndochronicFitCase, FindsTheLawAndWritesACaseThatRuns) {
  const FitCase fit;
  const Outcome outcome = run({"fit", fit.directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
  EXPECT_EQ(json["kind"], "endochronic");
  EXPECT_EQ(json["method"], "joint");
  ASSERT_EQ(json["parameters"].size(), 6u);
  EXPECT_EQ(json["parameters"][0]["name"], "C_1");
  EXPECT_NEAR(json["parameters"][0]["estimate"].get<double>(), 30e9, 30e9 * 1e-5);
  EXPECT_NEAR(json["parameters"][3]["estimate"].get<double>(), 60.0, 60.0 * 1e-5);
  EXPECT_NEAR(json["parameters"][4]["estimate"].get<double>(), 2.0, 2e-5);
  EXPECT_LT(json["experiments"][0]["relative_misfit"].get<double>(), 1e-7);
  EXPECT_EQ(json["correlation"].size(), 6u);
  EXPECT_GT(json["path"].size(), 3u);
  const CsvTable curve = read_csv(fit.directory.results() / "fit_cycles_0_5__.csv");
  EXPECT_EQ(curve.n_rows(), 91u);
  EXPECT_EQ(curve.column("measured_stress_xx_Pa").size(), 91u);
  EXPECT_NE(content_of(fit.directory.results() / "fit.log").find("f_inf"), std::string::npos);

  const std::filesystem::path fitted = fit.directory.results() / "case.fitted.toml";
  const EndochronicLaw law =
      read_endochronic_law(open_case(fitted).config.root().with_keys(endochronic_case_keys()).table("material"));
  EXPECT_NEAR(law.kernel[0].alpha, 700.0, 700.0 * 1e-5);
  EXPECT_EQ(run({"check", fitted.string()}).status, 0) << run({"check", fitted.string()}).err;
  EXPECT_EQ(run({"run", fitted.string(), "--output", (fit.directory.path() / "again").string()}).status, 0);
}

const std::string predicted_experiment = R"(
[[fit.experiments]]
name = "larger cycles"
csv = "larger.csv"
predicted = true
strain = { strain_xx = { column = "strain_xx" } }
stress = { stress_xx = { column = "stress_xx_Pa", unit = "Pa" } }
)";

/// Cycles of 0.8 % by the true law in larger.csv, their stress times `factor`.
void write_larger_cycles(const FitCase& fit, double factor) {
  const TemporaryCase larger(replaced(cyclic_case(true_kernel, "2.0"), "0.005*sin", "0.008*sin"));
  ASSERT_EQ(run({"run", larger.path().string(), "--quiet"}).status, 0);
  const CsvTable history = read_csv(larger.results() / "history.csv");
  CsvTable table;
  std::vector<double> stress = history.column("stress_xx_Pa");
  for (double& value : stress) value *= factor;
  table.comments = {"synthetic"};
  table.add("time_s", history.column("time_s"));
  table.add("strain_xx", history.column("strain_xx"));
  table.add("stress_xx_Pa", stress);
  write_csv(fit.directory.path() / "larger.csv", table);
}

TEST(EndochronicFitCase, PredictsExperimentsThatItIsNotFittedTo) {
  const FitCase fit(fit_table + predicted_experiment);
  write_larger_cycles(fit, 1.0);
  const Outcome outcome = run({"fit", fit.directory.path().string(), "--strict"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto good = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
  ASSERT_EQ(good["experiments"].size(), 2u);
  EXPECT_EQ(good["residuals"], good["experiments"][0]["data"]) << "the predicted curve is not fitted";
  EXPECT_FALSE(good["experiments"][1]["fitted"].get<bool>());
  EXPECT_LT(good["experiments"][1]["relative_misfit"].get<double>(), 1e-5);
  EXPECT_TRUE(std::filesystem::exists(fit.directory.results() / "fit_larger_cycles.csv"));
  EXPECT_EQ(run({"report", fit.directory.path().string()}).status, 0);

  write_larger_cycles(fit, 1.1);
  const Outcome missed = run({"fit", fit.directory.path().string(), "--strict"});
  EXPECT_EQ(missed.status, 1);
  const auto bad = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
  EXPECT_EQ(bad["verdict"], "questionable");
  EXPECT_NE(bad["reasons"].dump().find("larger cycles"), std::string::npos) << bad["reasons"];
  EXPECT_NEAR(bad["experiments"][1]["relative_misfit"].get<double>(), 0.1 / 1.1, 1e-5);
}

const std::string creep_experiment = R"(
[[fit.experiments]]
name = "creep"
csv = "creep.csv"
controlled = "stress"
stress = { stress_xx = { column = "stress_xx_Pa" } }
strain = { strain_xx = { column = "strain_xx" }, strain_yy = { column = "strain_yy" } }
)";

/// A test at given stress by the true law in creep.csv.
void write_creep(const FitCase& fit) {
  std::string text = cyclic_case(true_kernel, "2.0");
  const TemporaryCase creep(text.substr(0, text.find("control = ")) +
                            "control = { stress_xx = { expr = \"1e8*sin(2*pi*t)\", unit = \"Pa\" } }\n");
  ASSERT_EQ(run({"run", creep.path().string(), "--quiet"}).status, 0);
  fit.directory.write("creep.csv", "# synthetic\n" + content_of(creep.results() / "history.csv"));
}

TEST(EndochronicFitCase, FitsStrainsAtGivenStressToo) {
  const FitCase fit(fit_table + creep_experiment);
  write_creep(fit);
  const Outcome outcome = run({"fit", fit.directory.path().string(), "--strict"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
  EXPECT_NEAR(json["parameters"][0]["estimate"].get<double>(), 30e9, 30e9 * 1e-5);
  EXPECT_EQ(json["experiments"][1]["quantity"], "strain");
  EXPECT_EQ(json["experiments"][1]["data"], 182);
  EXPECT_EQ(json["residuals"], 91 + 182);
  EXPECT_LT(json["experiments"][1]["relative_misfit"].get<double>(), 1e-6);
  const CsvTable curve = read_csv(fit.directory.results() / "fit_creep.csv");
  const auto &measured = curve.column("measured_strain_yy"), &fitted = curve.column("fitted_strain_yy");
  for (std::size_t i = 0; i < measured.size(); ++i) EXPECT_NEAR(fitted[i], measured[i], 1e-8);
  EXPECT_EQ(curve.column("stress_xx_Pa").size(), 91u);
  EXPECT_EQ(run({"report", fit.directory.path().string()}).status, 0);
  EXPECT_EQ(run({"compare", fit.directory.path().string()}).status, 0);
  const auto compared = nlohmann::json::parse(content_of(fit.directory.results() / "comparison.json"));
  EXPECT_GT(compared["experiments"][1]["rms_misfit"].get<double>(), 1e-5) << "the first guess is wrong";
}

// A first guess with a twentieth of the stresses that it has to bear.
TEST(EndochronicFitCase, StartsWithALawThatBearsTheCreep) {
  const FitCase fit(fit_table + creep_experiment);
  write_creep(fit);
  const std::string text = content_of(fit.directory.path() / "case.toml");
  fit.directory.write("case.toml", replaced(replaced(text, "20 GPa", "1 GPa"), "6 GPa", "0.3 GPa"));
  const Outcome outcome = run({"fit", fit.directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("the fit starts with C "), std::string::npos) << outcome.out;
}

// The misfit of the case's own law, found from the columns of the curve.
TEST(EndochronicFitCase, IsComparedWithoutAFit) {
  const FitCase fit;
  const Outcome outcome = run({"compare", fit.directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "comparison.json"));
  const auto& experiment = json["experiments"][0];
  const CsvTable curve = read_csv(fit.directory.results() / experiment["curve"].get<std::string>());
  const auto &measured = curve.column("measured_stress_xx_Pa"), &computed = curve.column("computed_stress_xx_Pa");
  double misfit = 0.0, all = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    misfit += std::pow(computed[i] - measured[i], 2);
    all += std::pow(measured[i], 2);
  }
  EXPECT_NEAR(experiment["relative_misfit"].get<double>(), std::sqrt(misfit / all), 1e-9);
  EXPECT_GT(misfit, 1e-4 * all) << "the first guess is wrong";
  EXPECT_FALSE(std::filesystem::exists(fit.directory.results() / "fit.json"));

  const TemporaryCase none(cyclic_case(true_kernel, "2.0"));
  EXPECT_EQ(run({"compare", none.path().string()}).status, 2);
}

TEST(EndochronicFitCase, EveryMethodRuns) {
  for (const std::string method : {"kernel", "hardening", "staggered"}) {
    const FitCase fit(replaced(fit_table, "\"joint\"", '"' + method + '"'));
    const Outcome outcome = run({"fit", fit.directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << method << ": " << outcome.err;
    const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
    EXPECT_EQ(json["method"], method);
    EXPECT_EQ(json["verdict"] == "sound", method == "staggered") << json["reasons"];  // the others keep a wrong part
    EXPECT_EQ(json["parameters"].dump().find("f_inf") != std::string::npos, method != "kernel");
    EXPECT_EQ(json["endochronic"].contains("staggered_rounds"), method == "staggered");
    EXPECT_EQ(std::filesystem::exists(fit.directory.results() / "transient_fit_cycles_0_5__.csv"), method != "kernel");
  }
}

// Curves of laws with a yield surface, and of Ramberg and Osgood, are not the law's.
TEST(EndochronicFitCase, CurvesOfAnotherLawAreNamedAsSuch) {
  const std::vector<double> strain = independent::triangles(0.006, 4, 80);
  for (const bool yields : {false, true})
    for (const bool stated : {false, true}) {
      const FitCase fit(stated ? replaced(fit_table, "unit = \"Pa\" }", "unit = \"Pa\", noise = \"0.1 MPa\" }")
                               : fit_table);
      const MaterialExperiment test = independent::tension_test(
          strain, yields ? independent::chaboche(strain) : independent::ramberg_osgood(strain), 0.1e6, 1);
      CsvTable table;
      table.comments = {"made by the test"};
      table.add("time_s", test.loading.times);
      table.add("strain_xx", strain);
      table.add("stress_xx_Pa", test.channels[0].values);
      write_csv(fit.directory.path() / "cycles.csv", table);
      const Outcome outcome = run({"fit", fit.directory.path().string(), "--strict"});
      EXPECT_EQ(outcome.status, 1);
      const auto json = nlohmann::json::parse(content_of(fit.directory.results() / "fit.json"));
      EXPECT_NE(json["verdict"], "sound");
      EXPECT_NE(json["reasons"].dump().find("is the wrong model for these curves"), std::string::npos)
          << json["reasons"];
      EXPECT_TRUE(json["parameters"][0]["lower"].is_null());
      EXPECT_NE(outcome.out.find("no interval"), std::string::npos);
      EXPECT_EQ(run({"report", fit.directory.path().string()}).status, 0);
    }
}

TEST(EndochronicFitCase, CasesWithoutAFitSayThatThereIsNone) {
  const TemporaryCase directory(cyclic_case(true_kernel, "2.0"));
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("the case has no [fit] table"), std::string::npos) << outcome.err;
}

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
