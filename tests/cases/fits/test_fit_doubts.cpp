// What pfdm fit says of fits that must not be taken at their word, and what it does before a person has to. All data
// are SYNTHETIC, made by the tests.

#include "cases/program/input/config/result_number.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"
#include "tests/cases/glued_blocks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

json fitted(const TemporaryCase& directory, int status = 0) {
  const Outcome outcome = run({"fit", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, status) << outcome.err;
  return json::parse(content_of(directory.results() / "fit.json"));
}

// ---- Another law: two blocks with a cohesive interface

constexpr double compliance = 2e-3 / 1e9, area = 1e-6;  // of the blocks [m/Pa], [m^2]

/// Force at an elongation with exponential softening, T = ft exp(-ft w/Gc), by bisection [N].
double exponential_force(double u) {
  double low = 1e-9 * strength, high = strength;
  if (u <= compliance * strength) return area * u / compliance;
  for (int i = 0; i < 60; ++i) {
    const double T = 0.5 * (low + high);
    (T * compliance + toughness / strength * std::log(strength / T) > u ? low : high) = T;
  }
  return area * low;
}

/// With noise of half a per cent of the largest force, which is not stated.
void write_exponential_record(const TemporaryCase& directory) {
  std::mt19937 engine(2);
  std::normal_distribution<double> noise(0.0, 0.005 * area * strength);
  std::string text = "# SYNTHETIC: closed form with noise\nu_m,F_N\n0,0\n";
  for (int i = 1; i <= 110; ++i) text += fmt::format("{},{}\n", 1e-6 * i, exponential_force(1e-6 * i) + noise(engine));
  directory.write("glue.csv", text);
}

std::string hyperbolic_glue(const std::string& parameters) {
  const std::string glue = replaced(linear_glue, "\"linear\"", "\"hyperbolic\"");
  std::string text = replaced(replaced(glued_blocks(glue), "maximum_increment = 0.1", "maximum_increment = 0.02"),
                              "initial_increment = 0.1", "initial_increment = 0.01");
  return text + R"(
[experiment]
stiffness_between = ["0 um", "4 um"]
offset = "0 um"
force_offset = "0 N"
[[experiment.specimens]]
name = "glue"
csv = "glue.csv"
displacement = { column = "u_m" }
force = { column = "F_N" }
[fit]
differences = "forward"
[[fit.parameters]]
key = "interface[0].strength"
bounds = ["0.5 MPa", "8 MPa"]
[[fit.parameters]]
key = "interface[0].toughness"
bounds = ["20 J/m^2", "2000 J/m^2"]
)" + parameters;
}

TEST(FitDoubts, NamesAnotherLaw) {
  const TemporaryCase directory(hyperbolic_glue(""));
  write_exponential_record(directory);
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "questionable");
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("interface[0].law = \\\"exponential\\\" in place of \\\"hyperbolic"));
  EXPECT_THAT(fit["reasons"].dump(), Not(HasSubstr("correct the measured curve")));
}

// With it the residuals are small: the curve moves along its own straight part.
TEST(FitDoubts, RefusesAForceOffsetOfACurveThatBeginsUnloaded) {
  const TemporaryCase directory(
      hyperbolic_glue("[[fit.parameters]]\nkey = \"experiment.force_offset\"\nbounds = [\"-1 N\", \"1 N\"]\n"));
  write_exponential_record(directory);
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "questionable");
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("contradicts the first row of glue"));
  EXPECT_TRUE(fit["parameters"][0]["lower"].is_null());
}

// ---- A bar that breaks at once

std::string specimen(const std::string& name, const std::string& deviation = "") {
  return fmt::format(
      "[[experiment.specimens]]\nname = \"{0}\"\ncsv = \"{0}.csv\"\ndisplacement = {{ column = \"u_m\" }}\n"
      "force = {{ column = \"F_N\" }}\n{1}",
      name, deviation);
}

std::string experiment(const std::string& specimens) {
  return "\n[experiment]\nstiffness_between = [\"1 um\", \"5 um\"]\n" + specimens;
}

const std::string fitted_modulus =
    "\n[fit]\n[[fit.parameters]]\nkey = \"materials.concrete.young_modulus\"\nbounds = [\"10 GPa\", \"90 GPa\"]\n";
const std::string elastic = "[[fit.stages]]\nname = \"elastic\"\nbetween = [\"0 um\", \"6 um\"]\n";

/// The bar is held on all sides: it is stiffer by 1/0.9.
constexpr double stiffness_33_GPa = 33e9 / 0.9 * 1e-6 / 20e-3;  // [N/m]

/// Force of the bar of 33 GPa with noise of this deviation [N].
std::string straight_record(double noise, unsigned seed, int n = 60, double factor = 1.0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0.0, noise);
  std::string text = "# SYNTHETIC\nu_m,F_N,s\n";
  for (int i = 1; i <= n; ++i) {
    const double u = 6e-6 * i / n;
    text += fmt::format("{},{},{}\n", u, factor * stiffness_33_GPa * u + normal(engine), noise);
  }
  return text;
}

TEST(FitDoubts, ForcesInAnotherUnitAreNoFitAlsoWhereTheNoiseIsStated) {
  const TemporaryCase directory(bar_case() + experiment(specimen("one", "deviation = { column = \"s\" }\n")) +
                                fitted_modulus + elastic);
  directory.write("one.csv", straight_record(1e-4, 1, 60, 1e-3));
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "failed") << fit["reasons"];
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("times what was measured"));
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("times the computed ones of the first guess: the unit or the factor"));
}

TEST(FitDoubts, SpecimensAreWeightedByTheirOwnScatter) {
  const TemporaryCase directory(bar_case() + experiment(specimen("fine") + specimen("coarse")) + fitted_modulus +
                                elastic);
  directory.write("fine.csv", straight_record(0.01, 1));
  directory.write("coarse.csv", straight_record(0.5, 2));
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const json& p = fit["parameters"][0];
  // Standard error of the slope through the origin from the fine specimen alone, of the modulus.
  double squares = 0.0;
  for (int i = 1; i <= 60; ++i) squares += std::pow(1e-7 * i, 2);
  const double expected = 0.01 / std::sqrt(squares) / stiffness_33_GPa * 33e9;
  EXPECT_LT(p["standard_error"].get<double>(), 6.0 * expected) << "equal weights: 35 times";
  EXPECT_NEAR(p["estimate"].get<double>(), 33e9, 4.0 * p["standard_error"].get<double>());
}

// The bar that is four times as tough does not break within the record: every descent from there ends at once.
TEST(FitDoubts, AFirstGuessFourTimesOffIsScreenedByItself) {
  const std::string bar = replaced(replaced(bar_case(), "maximum_increment = 0.1", "maximum_increment = 0.02"),
                                   "initial_increment = 0.1", "initial_increment = 0.02");
  const TemporaryCase truth(bar);
  ASSERT_EQ(run({"run", truth.path().string(), "--quiet"}).status, 0);
  const CsvTable curve = read_csv(truth.results() / "force_displacement.csv");
  CsvTable data;
  data.comments = {"SYNTHETIC, a run"};
  data.add("u_m", curve.column("displacement_m"));
  data.add("F_N", curve.column("force_x_N"));
  const std::string far = replaced(replaced(bar, "\"100 J/m^2\"", "\"400 J/m^2\""), "\"80 J/m^2\"", "\"320 J/m^2\"");
  const TemporaryCase directory(far + experiment(specimen("one")) +
                                "\n[fit]\n[[fit.parameters]]\nkey = [\"materials.concrete.toughness\", "
                                "\"regions.weak.toughness\"]\nbounds = [\"10 J/m^2\", \"500 J/m^2\"]\n");
  write_csv(directory.path() / "one.csv", data);
  const json fit = fitted(directory);
  EXPECT_NEAR(fit["parameters"][0]["estimate"].get<double>(), 100.0, 3.0);
  EXPECT_NE(fit["verdict"], "failed");
}

// ---- The mesh's error beside the interval

TEST(FitDoubts, TellsHowFarAFinerModelMovesTheEstimates) {
  // Twice as many cells: the straight part is what it was.
  const TemporaryCase directory(
      bar_case() + experiment(specimen("one")) +
      replaced(fitted_modulus, "[fit]\n", "[fit]\nfiner = { \"mesh.x[0].cells\" = 42, \"mesh.y[0].cells\" = 4 }\n") +
      elastic);
  directory.write("one.csv", straight_record(0.05, 1));
  const json fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_EQ(fit["finer"], "mesh.x[0].cells = 42, mesh.y[0].cells = 4");
  EXPECT_LT(std::abs(fit["parameters"][0]["moved_by_finer"].get<double>()), 1e-3 * 33e9);
}

// A stiffness that depends on a value which the finer case changes: 1.1 times as stiff, so that 1.1 times less modulus
// is needed.
TEST(FitDoubts, MovesByWhatTheFinerModelIsStiffer) {
  const TemporaryCase directory(
      bar_case() + experiment(specimen("one")) +
      replaced(fitted_modulus, "[fit]\n", "[fit]\nfiner = { \"mesh.y[0].length\" = \"1.1 mm\" }\n") + elastic);
  directory.write("one.csv", straight_record(0.05, 1));
  const Outcome outcome = run({"fit", directory.path().string(), "--quiet"});
  const json fit = json::parse(content_of(directory.results() / "fit.json"));
  const json& p = fit["parameters"][0];
  EXPECT_NEAR(p["estimate"].get<double>() + p["moved_by_finer"].get<double>(), 33e9 * std::exp(-0.1), 2e-3 * 33e9);
  EXPECT_THAT(outcome.err,
              HasSubstr("standard errors): more than what the noise leaves open of materials.concrete.young_modulus"));
  EXPECT_EQ(fit["verdict"], "sound within the error of mesh and steps");
  EXPECT_LT(p["lower"].get<double>(), 33e9 * std::exp(-0.1)) << "the interval holds what the finer model says";
  EXPECT_GT(p["upper"].get<double>(), p["estimate"].get<double>());
  EXPECT_LT(p["upper"].get<double>(), p["estimate"].get<double>() + 3.0 * p["standard_error"].get<double>());
  EXPECT_THAT(outcome.err, HasSubstr("materials.concrete.young_modulus would be 29.")) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(" GPa (-")) << outcome.err;
}

TEST(FitDoubts, RefusesAFinerModelThatIsNone) {
  const TemporaryCase wrong(bar_case() + experiment(specimen("one")) +
                            replaced(fitted_modulus, "[fit]\n", "[fit]\nfiner = { \"mesh.q\" = 42 }\n"));
  wrong.write("one.csv", straight_record(0.05, 1));
  const Outcome outcome = run({"fit", wrong.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("[mesh] has no \"q\""));
}

// ---- Chains

std::string chain_of(const std::string& accept) {
  return "kind = \"chain\"\ntitle = \"a fit and what is built on it\"\n[[step]]\ncase = \"bar\"\ndoes = \"fit\"\n" +
         accept + "[[step]]\ncase = \"next\"\n";
}

/// Two points for one parameter: questionable.
class ChainOfAFit : public testing::Test {
 protected:
  ChainOfAFit() : directory(chain_of("")) {
    fs::create_directories(directory.path() / "bar");
    fs::create_directories(directory.path() / "next");
    directory.write("bar/case.toml", bar_case() + experiment(specimen("one")) + fitted_modulus + elastic);
    directory.write("bar/one.csv", straight_record(0.01, 1, 2));
    directory.write(
        "next/case.toml",
        replaced(
            bar_case(), "young_modulus = \"30 GPa\"",
            "young_modulus = { from = \"../bar/results/fit.json\", key = \"parameters[0].estimate\", unit = \"Pa\" }"));
  }
  TemporaryCase directory;
};

TEST_F(ChainOfAFit, StopsWhereItIsNotSound) {
  const Outcome stopped = run({"run", directory.path().string()});
  EXPECT_EQ(stopped.status, 1);
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("the fit is questionable"), HasSubstr("accept = \"questionable\"")));
  EXPECT_FALSE(fs::exists(directory.path() / "next/results"));
}

TEST_F(ChainOfAFit, GoesOnWhereItIsTold) {
  directory.write("case.toml", chain_of("accept = \"questionable\"\n"));
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("later steps use its estimates all the same"));
  EXPECT_TRUE(fs::exists(directory.path() / "next/results/summary.json"));

  directory.write("case.toml", chain_of("accept = \"failed\"\n"));
  EXPECT_EQ(run({"check", directory.path().string()}).status, 2);
}

// Names in fit.json are known before there is one; lists may be longer.
TEST_F(ChainOfAFit, RefusesFiguresThatNoFitHas) {
  for (const auto& [key, status] : {std::pair("parameters[0].estimat", 2), std::pair("parameter[0].estimate", 2),
                                    std::pair("parameters.estimate", 2), std::pair("parameters[7].profile.upper", 0),
                                    std::pair("experiments[0].rms_misfit_N", 0)}) {
    directory.write("case.toml", chain_of(fmt::format("figures = [{{ says = \"it\", key = \"{}\" }}]\n", key)));
    EXPECT_EQ(run({"check", directory.path().string()}).status, status) << key;
  }
  ASSERT_EQ(run({"fit", (directory.path() / "bar").string(), "--quiet"}).status, 0);
  const json found = json::parse(content_of(directory.path() / "bar/results/fit.json")).flatten();
  for (const auto& [pointer, value] : found.items()) {
    std::string key = pointer.substr(1);
    std::ranges::replace(key, '/', '.');
    if (!value.is_number()) continue;
    EXPECT_NO_THROW(require_key_like(fit_json_like("fracture"), "fit.json", key)) << key;
  }
}

// What depends on a step that will be done is not called done.
TEST_F(ChainOfAFit, ChecksSayWhatMayBeDoneAgain) {
  directory.write("case.toml", chain_of("accept = \"questionable\"\n"));
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  EXPECT_THAT(run({"check", directory.path().string()}).out, HasSubstr("step next: run, done\n"));
  directory.write("bar/one.csv", straight_record(0.01, 2, 2));
  EXPECT_THAT(run({"check", directory.path().string()}).out,
              AllOf(HasSubstr("step bar: fit, to be done"), HasSubstr("step next: run, done again if \"bar\" gives")));
}

}  // namespace
}  // namespace pfdm::this_file
