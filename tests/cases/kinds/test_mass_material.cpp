// Cases of kind mass_material from end to end: simulated and identified.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/vibration/mass_material_case.h"
#include "tests/cases/page_data.h"
#include "tests/cases/soft_sample.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(MassMaterialProgram, SimulatesItsTests) {
  const TemporaryCase directory(soft_case());
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const fs::path results = directory.results();
  for (const char* file : {"up.csv", "down.csv", "up_harmonics.csv", "down_harmonics.csv", "summary.json", "run.log"})
    EXPECT_TRUE(fs::exists(results / file)) << file;
  const std::string record = content_of(results / "up.csv");
  EXPECT_TRUE(record.starts_with("# synthetic: simulated, not measured"));
  EXPECT_NE(record.find("\ntime,base_acceleration,relative_acceleration\ns,m/s^2,m/s^2\n"), std::string::npos);
  EXPECT_EQ(std::count(record.begin(), record.end(), '\n'), 3 + 6001);
  const json summary = parsed(results / "summary.json");
  EXPECT_EQ(summary["status"], "complete");
  EXPECT_NEAR(summary["tests"][0]["peak_base_acceleration_m_per_s2"].get<double>(), 2 * 9.80665, 0.01);
  EXPECT_NEAR(summary["static_settling_point_m"].get<double>(), -1.12 * 9.80665 / 54e3, 2e-6);
}

// Results of a test that the case no longer has go with the others; those of a run that breaks off come to nothing.
TEST(MassMaterialProgram, ReplacesEarlierResultsAsAWhole) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const std::string summary = content_of(directory.results() / "summary.json");
  EXPECT_NE(summary.find("\"samples\": 6001"), std::string::npos) << summary;
  EXPECT_EQ(summary.find("6001.0"), std::string::npos) << summary;
  const std::string up = content_of(directory.results() / "up.csv");
  directory.write("case.toml", replaced(soft_case(), "\"1.3e8 N/m^3\"", "\"-1e11 N/m^3\""));
  ASSERT_EQ(run({"run", directory.path().string()}).status, 1);
  EXPECT_EQ(content_of(directory.results() / "summary.json"), summary);
  EXPECT_EQ(content_of(directory.results() / "up.csv"), up);
  directory.write("case.toml", replaced(soft_case(), "name = \"up\"", "name = \"upwards\""));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("belong to different input: this run starts anew and replaces them"), std::string::npos);
  EXPECT_FALSE(fs::exists(directory.results() / "up.csv"));
  EXPECT_TRUE(fs::exists(directory.results() / "upwards.csv"));
  EXPECT_FALSE(fs::exists(directory.results() / ".new.partial"));
}

TEST(MassMaterialProgram, FitsOgdensModelToTheStiffness) {
  const TemporaryCase directory(replaced(soft_case(), "replicates = 50", "replicates = 20\nogden_terms = 2"));
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Ogden's model of k(z)"), std::string::npos) << outcome.out;
  const json ogden = parsed(directory.results() / "fit.json")["mass_material"]["ogden"];
  // Three times the shear modulus is Young's, k1 L/A.
  EXPECT_NEAR(3.0 * ogden["shear_modulus_Pa"].get<double>(), 54e3 * 0.0762 / 45.6e-4, 0.01 * 54e3 * 0.0762 / 45.6e-4);
  EXPECT_LT(ogden["relative_misfit"].get<double>(), 0.01);
  EXPECT_GT(ogden["largest_displacement_m"].get<double>(), 1e-3);
  EXPECT_LT(ogden["largest_displacement_m"].get<double>(), 0.02);
  ASSERT_EQ(run({"report", directory.path().string()}).status, 0);
  const json page = data_of_page(content_of(directory.results() / "report" / "index.html"));
  EXPECT_THAT(page["headline"].front().get<std::string>(), testing::StartsWith("Mass and sample resonate at 3"));
  EXPECT_THAT(page["headline"][1].get<std::string>(), testing::EndsWith("mm against it."));
  EXPECT_THAT(page["headline"].back().get<std::string>(), testing::StartsWith("The fit is "));
  const json& figures = page["figures"];
  const std::pair<const char*, const char*> shown[] = {{"k1", "kN/m"}, {"k2", "MN/m²"}, {"k3", "MN/m³"}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(figures[i]["label"], shown[i].first);
    EXPECT_TRUE(figures[i]["value"].get<std::string>().ends_with(shown[i].second)) << figures[i];
  }
  const std::string no_sample = replaced(replaced(soft_case(), "replicates = 50", "ogden_terms = 2"),
                                         "[sample]\nlength = \"76.2 mm\"\narea = \"45.6 cm^2\"\n", "");
  const TemporaryCase without(no_sample);
  const Outcome refused = run({"check", without.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("needs the sample's length and area"), std::string::npos) << refused.err;
}

TEST(MassMaterialProgram, SimulatesRandomMotionWithSpectra) {
  const std::string random =
      "type = \"random\", density = \"0.01 g0^2/Hz\", from = \"10 Hz\", to = \"200 Hz\", seed = 3, ";
  const std::string text =
      replaced(soft_case(), "type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", ", random);
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(content_of(directory.results() / "up_spectra.csv").find("coherence") != std::string::npos);
}

TEST(MassMaterialProgram, FindsItsOwnParametersAgain) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json fit = parsed(directory.results() / "fit.json");
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_TRUE(outcome.out.ends_with("verdict: sound\n")) << outcome.out;
  const double expected[] = {54e3, -1.0e6, 1.3e8};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(fit["parameters"][i]["estimate"].get<double>(), expected[i], 0.02 * std::abs(expected[i])) << i;
  EXPECT_EQ(fit["format"], 1);
  EXPECT_EQ(fit["kind"], "mass_material");
  const json& damping = fit["parameters"][5];
  EXPECT_NEAR(damping["estimate"].get<double>(), 40.0, 0.02);
  EXPECT_EQ(damping["name"], "c_N_s_per_m");
  EXPECT_EQ(damping["unit"], "N s/m");
  EXPECT_LT(damping["lower"].get<double>(), damping["estimate"].get<double>());
  EXPECT_NEAR(damping["first_guess"].get<double>(), 40.0, 10.0);
  // The interval of 95 % is 3.92 standard errors wide, and by Student's t more where few blocks know of a parameter.
  const auto width = [](const json& p) {
    return (p["upper"].get<double>() - p["lower"].get<double>()) / p["standard_error"].get<double>();
  };
  for (const json& p : fit["parameters"]) {
    EXPECT_GT(width(p), 3.2) << p["name"];
    EXPECT_LT(width(p), 26.0) << p["name"];
  }
  EXPECT_GT(fit["evaluations"].get<int>(), 10);
  EXPECT_EQ(fit["path"].back()["parameters"][5], damping["estimate"]);
  EXPECT_EQ(fit["experiments"][0]["fitted"], true);
  EXPECT_EQ(fit["experiments"][1]["name"], "down");
  EXPECT_EQ(fit["experiments"][1]["fitted"], false);
  EXPECT_LT(fit["experiments"][1]["relative_misfit"].get<double>(), 1e-3);
  EXPECT_TRUE(fit["mass_material"]["passive"].get<bool>());
  EXPECT_EQ(fit["correlation"].size(), 6u);
  // E = k1 L/A, and E'' = omega c L/A.
  const json& modulus = fit["mass_material"]["youngs_modulus"][0];
  EXPECT_NEAR(modulus["frequency_Hz"].get<double>(), 10.0, 1e-6);
  EXPECT_NEAR(modulus["storage_modulus_Pa"].get<double>(), 54e3 * 0.0762 / 45.6e-4, 1e3);
  EXPECT_NEAR(modulus["loss_modulus_Pa"].get<double>(), 62.8319 * 40 * 0.0762 / 45.6e-4, 50.0);
}

// The record is of model 2: model 1 lacks its nonlinear stiffness, model 3 has a damping exponent too many.
TEST(MassMaterialProgram, ComparesSeveralModels) {
  const TemporaryCase directory(soft_case() + "models = [\"1\", \"2\", \"3\"]\n");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json all = parsed(directory.results() / "fit_models.json");
  EXPECT_EQ(all["chosen"], "2");
  ASSERT_EQ(all["models"].size(), 3u);
  const json &linear = all["models"][0], &right = all["models"][1], &richer = all["models"][2];
  EXPECT_EQ(linear["verdict"], "questionable");
  EXPECT_TRUE(linear["parameters"][0]["lower"].is_null());
  EXPECT_EQ(right["verdict"], "sound") << right["reasons"];
  EXPECT_GT(linear["relative_misfit"].get<double>(), 10.0 * right["relative_misfit"].get<double>());
  EXPECT_GT(linear["bic"].get<double>(), right["bic"].get<double>());
  EXPECT_GT(richer["bic"].get<double>(), right["bic"].get<double>());
  EXPECT_LT(right["predicted_relative_misfit"].get<double>(), 1e-3);
  const json fit = parsed(directory.results() / "fit.json");
  EXPECT_EQ(fit["mass_material"]["structure"], "2");
  EXPECT_EQ(fit["parameters"][0]["estimate"], right["parameters"][0]["estimate"]);
  for (const char* name : {"1", "2", "3"})
    EXPECT_TRUE(fs::exists(directory.results() / fmt::format("case.fitted_{}.toml", name)));
  ASSERT_EQ(run({"report", directory.path().string()}).status, 0);
  // A fit of one model leaves no table of another one.
  const std::string text = content_of(directory.path() / "case.toml");
  directory.write("case.toml", text.substr(0, text.find("models =")));
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  EXPECT_FALSE(fs::exists(directory.results() / "fit_models.json"));
  EXPECT_FALSE(fs::exists(directory.results() / "case.fitted_3.toml"));
}

TEST(MassMaterialProgram, SaysThatTheSignOfAChannelIsReversed) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  std::istringstream lines(content_of(directory.results() / "up.csv"));
  std::string line, turned;
  for (int i = 0; std::getline(lines, line); ++i) {
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    turned += i < 3 ? line
                    : fmt::format("{},{:.17g}{}", line.substr(0, first), -std::stod(line.substr(first + 1)),
                                  line.substr(second));
    turned += '\n';
  }
  directory.write("results/up.csv", turned);
  const Outcome outcome = run({"fit", directory.path().string(), "--strict"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE((outcome.out + outcome.err).find("test up: the sign of one channel is reversed"), std::string::npos)
      << outcome.out << outcome.err;
  if (fs::exists(directory.results() / "fit.json")) {
    const json fit = parsed(directory.results() / "fit.json");
    EXPECT_NE(fit["verdict"], "sound");
    EXPECT_TRUE(fit["parameters"][0]["lower"].is_null());
    EXPECT_EQ(run({"report", directory.path().string()}).status, 0);
  }
}

TEST(MassMaterialProgram, EndsWithStatusOneWhereTheMassRunsAway) {
  const TemporaryCase directory(replaced(soft_case(), "\"1.3e8 N/m^3\"", "\"-1e11 N/m^3\""));
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("test up: the motion is unbounded"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(directory.results() / "summary.json"));
}

TEST(MassMaterialProgram, HasNoMesh) {
  const TemporaryCase directory(soft_case());
  EXPECT_EQ(run({"mesh", directory.path().string()}).status, 2);
}

TEST(MassMaterialProgram, ListsItsLaws) {
  const Outcome laws = run({"list", "--laws"});
  for (const char* name : {"mass_material", "4a", "table4_7", "swept_sine", "random", "output_error"})
    EXPECT_NE(laws.out.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace pfdm::this_file
