// pfdm fit on cases of kind "endochronic", with data that the program made itself.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_case.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_fit.h"
#include "tests/cases/temporary_case.h"
#include "tests/solver/independent_simulators.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

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

}  // namespace
}  // namespace pfdm::this_file
