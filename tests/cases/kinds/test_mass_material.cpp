// Cases of kind mass_material from end to end: simulated, identified, and what is wrong with them said.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/kinds.h"
#include "cases/program/vibration/mass_material_case.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string soft_case() {
  return R"(kind = "mass_material"
title = "a soft sample"

[model]
structure = "2"
mass = "1.12 kg"
stiffness = ["54 kN/m", "-1.0e6 N/m^2", "1.3e8 N/m^3"]
damping = "40 N s/m"

[sample]
length = "76.2 mm"
area = "45.6 cm^2"

[sampling]
rate = "1 kHz"
signal_to_noise_dB = 80

[[test]]
name = "up"
excitation = { type = "swept_sine", level = "2 g0", from = "10 Hz", to = "70 Hz", duration = "6 s" }

[[test]]
name = "down"
predicted = true
excitation = { type = "swept_sine", level = "1.5 g0", from = "70 Hz", to = "10 Hz", duration = "6 s", law = "logarithmic" }

[fit]
replicates = 50
)";
}

json parsed(const fs::path& file) { return json::parse(content_of(file)); }

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

TEST(BadMassMaterial, ListsOfModels) {
  for (const auto& [keys, message] :
       {std::pair("models = []", "the list of models is empty"), std::pair("models = [\"1\", \"1\"]", "listed twice"),
        std::pair("structure = \"1\"\nmodels = [\"2\"]", "give one of them")}) {
    const TemporaryCase directory(soft_case() + keys + "\n");
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
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

/// Three runs at each of two levels on each of two days.
std::string repeated_case() {
  std::string text = R"(kind = "mass_material"
title = "a sample that stiffens"

[model]
structure = "1"
mass = "1.12 kg"
stiffness = ["54 kN/m"]
damping = "40 N s/m"

[sampling]
rate = "1 kHz"
signal_to_noise_dB = 60

[[change]]
of = "stiffness"
per_g0 = -0.02
per_day = 0.004
scatter = 0.001

[fit]
repeatability = true
replicates = 50
)";
  const int levels[] = {1, 1, 2, 2, 1, 2};
  for (const int day : {7, 12})
    for (int run = 1; run <= 6; ++run)
      text += fmt::format(R"(
[[test]]
name = "day{0}_{1}"
schedule = {{ level = "{2} g0", age = "{0} day", run = {1} }}
excitation = {{ type = "swept_sine", level = "{2} g0", from = "15 Hz", to = "70 Hz", duration = "4 s" }}
)",
                          day, run, levels[run - 1]);
  return text;
}

double slope(const json& parameter, const std::string& name, const char* what) {
  for (const json& effect : parameter["effects"])
    if (effect["name"] == name) return effect[what].get<double>();
  return std::nan("");
}

TEST(MassMaterialProgram, TellsSpreadAndDriftOverASchedule) {
  const TemporaryCase directory(repeated_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("repeatability over 12 records"), std::string::npos) << outcome.out;
  const json repeats = parsed(directory.results() / "fit.json")["mass_material"]["repeatability"];
  EXPECT_EQ(repeats["records"].size(), 12u);
  EXPECT_EQ(repeats["records"][7]["name"], "day12_2");
  EXPECT_EQ(repeats["records"][7]["run"], 2);
  EXPECT_DOUBLE_EQ(repeats["records"][7]["age_s"].get<double>(), 12 * 86400.0);
  const json& k1 = repeats["parameters"][0];
  EXPECT_EQ(k1["name"], "k1_N_per_m");
  EXPECT_NEAR(k1["mean"].get<double>(), 54e3, 100.0);
  EXPECT_NEAR(slope(k1, "per_g0", "value"), -0.02 * 54e3, 0.003 * 54e3);
  EXPECT_NEAR(slope(k1, "per_day", "value"), 0.004 * 54e3, 0.0006 * 54e3);
  EXPECT_GT(slope(k1, "per_day", "lower_95"), 0.0);
  EXPECT_LT(slope(k1, "per_run", "lower_95"), 0.0);  // there is none
  EXPECT_GT(slope(k1, "per_run", "upper_95"), 0.0);
  // The scatter is the sample's: the noise in the records makes far less.
  EXPECT_GT(k1["repeat_deviation"].get<double>(), 0.0004 * 54e3);
  EXPECT_LT(k1["repeat_deviation"].get<double>(), 0.002 * 54e3);
  EXPECT_LT(k1["expected_deviation"].get<double>(), 0.0003 * 54e3);
  EXPECT_EQ(k1["repeat_degrees_of_freedom"], 8);
  EXPECT_EQ(k1["residual_degrees_of_freedom"], 8);
  EXPECT_EQ(run({"report", directory.path().string()}).status, 0);
}

// The rows of two samples of Table A1.
TEST(MassMaterialProgram, ShowsTheStatusOfItsSchedule) {
  struct Scheduled {
    bool random;
    std::string schedule;
  };
  const auto rows_of = [](const std::string& sample, const std::vector<Scheduled>& tests) {
    std::string text = replaced(soft_case(), "[sampling]", sample + "[sampling]");
    text = text.substr(0, text.find("[[test]]"));
    for (std::size_t i = 0; i < tests.size(); ++i)
      text += fmt::format(
          "[[test]]\nname = \"t{}\"\nschedule = {{ {} }}\nexcitation = {{ type = \"{}\", {}, from = \"15 Hz\", to = "
          "\"70 Hz\", duration = \"4 s\" }}\n",
          i, tests[i].schedule, tests[i].random ? "random" : "swept_sine",
          tests[i].random ? "density = \"0.01 g0^2/Hz\"" : "level = \"1 g0\"");
    const TemporaryCase directory(text);
    return schedule_rows(read_mass_material_case(open_case(directory.path()).config.root(), directory.path()));
  };
  using Rows = std::vector<std::vector<std::string>>;
  const std::vector<Scheduled> second{{true, "level = \"0.025 g0^2/Hz\", age = \"86 day\""},
                                      {true, "level = \"0.05 g0^2/Hz\", age = \"86 day\""},
                                      {true, "level = \"0.025 g0^2/Hz\", age = \"102 day\""},
                                      {true, "level = \"0.05 g0^2/Hz\", age = \"102 day\""},
                                      {false, "level = \"1 g0\", age = \"109 day\""},
                                      {false, "level = \"2 g0\", age = \"109 day\", fractured = true"}};
  EXPECT_EQ(rows_of("name = \"P00_Q000_Q00_C02\"\ncomposition = \"HTPB 100 %\"\ncured = \"2016-02-29\"\n"
                    "planned_random = 10\nplanned_harmonic = 10\n",
                    second),
            (Rows{{"sample", "random, 0.025 g0²/Hz, day", "random, 0.05 g0²/Hz, day", "random, done of planned",
                   "harmonic, 1 g0, day", "harmonic, 2 g0, day", "harmonic, done of planned"},
                  {"P00_Q000_Q00_C02, HTPB 100 %, cured 2016-02-29", "86, 102", "86, 102", "4/10", "109", "109F",
                   "2/10 F"}}));
  EXPECT_EQ(rows_of("planned_harmonic = 3\n", {{true, "level = \"0.015 g0^2/Hz\", age = \"4.5 day\""}})[1],
            (std::vector<std::string>{"a soft sample", "4", "1/-", "0/3"}));
  EXPECT_EQ(rows_of("", {{true, "level = \"2 g0\", age = \"4 day\""}})[0][1],  // rms in 55 Hz
            "random, 0.07273 g0²/Hz, day");
}

struct BadSchedule {
  const char* name;
  const char* good;
  const char* bad;
  const char* message;
};

TEST(BadMassMaterial, SchedulesThatTellNothing) {
  const BadSchedule rows[] = {
      {"no schedule", "schedule = { level = \"1 g0\", age = \"7 day\", run = 2 }\n", "", "test day7_2 has no schedule"},
      {"another method", "repeatability = true", "repeatability = true\nmethod = \"least_squares\"",
       "repeatability requires the method \"output_error\""},
      {"run zero", "\"7 day\", run = 2 }", "\"7 day\", run = 0 }", "between 1 and 1000000"},
      {"density of a sine", "level = \"1 g0\", age = \"7 day\", run = 2",
       "level = \"0.05 g0^2/Hz\", age = \"7 day\", run = 2", "a density belongs to random motion"},
      {"unknown parameter", "of = \"stiffness\"", "of = \"mass\"", "\"mass\" is not a parameter that changes"},
  };
  for (const BadSchedule& row : rows) {
    SCOPED_TRACE(row.name);
    const TemporaryCase directory(replaced(repeated_case(), row.good, row.bad));
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(row.message), std::string::npos) << outcome.err;
  }
}

TEST(MassMaterialProgram, WritesACaseWithWhatItFound) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  const fs::path fitted = directory.results() / "case.fitted.toml";
  const Outcome outcome = run({"check", fitted.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto c = read_mass_material_case(open_case(fitted).config.root(), directory.path());
  EXPECT_NEAR(c.model.damping, 40.0, 0.02);
  EXPECT_EQ(c.model.stiffness.size(), 5u);
  EXPECT_EQ(c.tests.size(), 2u);
}

TEST(MassMaterialProgram, FittedTextKeepsEveryTerm) {
  MassMaterial m{.mass = 1.5,
                 .stiffness = {1e6, -2e9},
                 .damping = 0.1,
                 .damping_exponent = 1.25,
                 .reference_velocity = 0.3,
                 .forcing = KernelForcing::damping,
                 .kernel = {{400.0, 1.0 / 3.0}, {{20.0, 7.0}, {-1.0, 2.0}}}};
  const TemporaryCase directory(soft_case());
  directory.write("case.toml", with_table(open_case(directory.path()), "model", model_text("6", m), directory.path()));
  const auto c = read_mass_material_case(open_case(directory.path()).config.root(), directory.path());
  EXPECT_EQ(c.structure, "6");
  EXPECT_EQ(c.model.mass, m.mass);
  EXPECT_EQ(c.model.stiffness, m.stiffness);
  EXPECT_EQ(c.model.damping_exponent, m.damping_exponent);
  ASSERT_EQ(c.model.kernel.size(), 2u);
  EXPECT_EQ(c.model.kernel[0].beta, m.kernel[0].beta);
  EXPECT_EQ(c.model.kernel[1].alpha, m.kernel[1].alpha);
  EXPECT_EQ(c.model.kernel[1].beta, m.kernel[1].beta);
}

TEST(MassMaterialProgram, FittedTextNamesRecordsFromWhereItStands) {
  const TemporaryCase directory("[model]\nmass = 1\n[[test]]\nrecord = { file = \"data/day1.csv\", time = \"t\" }\n");
  const CaseFile file = open_case(directory.path());
  EXPECT_EQ(with_table(file, "model", "[model]\nmass = 2\n", directory.results()),
            "[model]\nmass = 2\n[[test]]\nrecord = { file = \"../data/day1.csv\", time = \"t\" }\n");
}

TEST(MassMaterialProgram, OffersTheReportsLeastSquares) {
  const TemporaryCase directory(soft_case() + "method = \"least_squares\"\n");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json fit = parsed(directory.results() / "fit.json");
  EXPECT_EQ(fit["method"], "least_squares");
  EXPECT_NEAR(fit["parameters"][0]["estimate"].get<double>(), 54e3, 0.05 * 54e3);
  EXPECT_TRUE(fit["parameters"][0]["lower"].is_null());
}

/// Rows of a CSV file below remark, names and units.
std::vector<std::vector<double>> rows_of(const fs::path& file) {
  std::istringstream text(content_of(file));
  std::vector<std::vector<double>> rows;
  int above = 2;  // names and units
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("#") || above-- > 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    rows.emplace_back();
    for (double x = 0.0; numbers >> x;) rows.back().push_back(x);
  }
  return rows;
}

// Iterations, Prony series and the kernel's responses of the report's A4.3; another method's fit takes them away.
TEST(MassMaterialProgram, DocumentsTheTenSteps) {
  const std::string ten_step = replaced(soft_case() + "method = \"ten_step\"\nkernel_order = 2\n", "[fit]\n",
                                        "[fit]\nstructure = \"linear_4b\"\n");
  const TemporaryCase directory(ten_step);
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("ten steps: "), std::string::npos) << outcome.out;
  const fs::path folder = directory.results() / "ten_steps";
  const auto iterations = rows_of(folder / "iterations.csv"), series = rows_of(folder / "prony_series.csv");
  const json parameters = parsed(directory.results() / "fit.json")["parameters"];
  ASSERT_FALSE(iterations.empty());
  EXPECT_DOUBLE_EQ(iterations.back()[2], parameters[0]["estimate"].get<double>());
  EXPECT_DOUBLE_EQ(iterations.back()[1], parameters[1]["estimate"].get<double>());
  ASSERT_FALSE(series.empty());
  for (std::size_t i = 1; i < series.size(); ++i) EXPECT_GE(series[i - 1][4], series[i][4]);
  // At t = 0 the impulse response is the sum of the weights, that of a pair twice the real part.
  double sum = 0.0, kept = 0.0;
  for (const auto& term : series) {
    const double weight = (term[1] != 0.0 ? 2.0 : 1.0) * term[2];
    sum += weight;
    kept += term[5] * weight;
  }
  const auto impulse = rows_of(folder / "kernel_impulse.csv");
  ASSERT_FALSE(impulse.empty());
  EXPECT_NEAR(impulse[0][1], sum, 1e-9 * std::abs(sum));
  EXPECT_NEAR(impulse[0][2], kept, 1e-9 * std::abs(kept));
  EXPECT_EQ(rows_of(folder / "kernel_response.csv").front().size(), 9U);
  directory.write("case.toml", soft_case());
  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  EXPECT_FALSE(fs::exists(folder));
}

TEST(MassMaterialProgram, SaysHowManyKernelTermsAMethodTakes) {
  const auto checked = [](const char* fit) {
    const TemporaryCase directory(soft_case() + fit);
    return run({"check", directory.path().string()});
  };
  EXPECT_EQ(checked("method = \"ten_step\"\nkernel_order = 20\n").status, 0);
  const Outcome beyond = checked("method = \"ten_step\"\nkernel_order = 21\n"),
                of_others = checked("kernel_order = 7\n");
  EXPECT_EQ(beyond.status, 2);
  EXPECT_NE(beyond.err.find("between 1 and 20"), std::string::npos) << beyond.err;
  EXPECT_EQ(of_others.status, 2);
  EXPECT_NE(of_others.err.find("between 0 and 6 (\"ten_step\": up to 20)"), std::string::npos) << of_others.err;
}

TEST(MassMaterialProgram, FitsARecordFromAFile) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  fs::create_directories(directory.path() / "data");
  fs::copy_file(directory.results() / "up.csv", directory.path() / "data/a.csv");
  const std::string text = replaced(
      soft_case(),
      "excitation = { type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", duration = \"6 s\" }",
      "record = { file = \"data/a.csv\", from = \"10 Hz\", to = \"70 Hz\" }");
  directory.write("case.toml", text);
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(parsed(directory.results() / "fit.json")["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  // A bad one is refused by file and name of the fault.
  std::string spoilt = content_of(directory.path() / "data/a.csv");
  const std::size_t line = spoilt.find("\n3,");
  spoilt.erase(line, spoilt.find("\n3.1,") - line);
  directory.write("data/a.csv", spoilt);
  const Outcome refused = run({"fit", directory.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("a.csv: gap: 0.1 s are missing"), std::string::npos) << refused.err;
}

// As integers of a recorder whose channels have full scales of 20 and 50 g0.
TEST(MassMaterialProgram, ReadsChannelsInUnitsOfTheirOwn) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  std::istringstream lines(content_of(directory.results() / "up.csv"));
  std::string scaled = "time,base_acceleration,relative_acceleration\ns,1,1\n";
  for (std::string line; std::getline(lines, line);) {
    double time = 0.0, base = 0.0, relative = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &base, &relative) == 3)
      scaled += fmt::format("{},{},{}\n", time, base / (20.0 * 9.80665), relative / (50.0 * 9.80665));
  }
  directory.write("scaled.csv", scaled);
  const auto fit = [&](const char* units) {
    directory.write(
        "case.toml",
        replaced(soft_case(),
                 "excitation = { type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", "
                 "duration = \"6 s\" }",
                 fmt::format("record = {{ file = \"scaled.csv\", from = \"10 Hz\", to = \"70 Hz\", {} }}", units)));
    return run({"fit", directory.path().string()});
  };
  EXPECT_EQ(fit("base_unit = \"20 g0\", relative_unit = \"50 g0\"").status, 0);
  EXPECT_NEAR(parsed(directory.results() / "fit.json")["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  EXPECT_EQ(fit("unit = \"20 g0\", relative_unit = \"50 g0\"").status, 0);
  EXPECT_NEAR(parsed(directory.results() / "fit.json")["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  const Outcome refused = fit("unit = \"50 g0\", base_unit = \"20 mm\"");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("scaled.csv: column \"base_acceleration\""), std::string::npos) << refused.err;
}

// The same record, with the mass's own acceleration x'' = y'' + z'' in the place of z''.
TEST(MassMaterialProgram, FitsARecordOfTheAbsoluteAcceleration) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  std::istringstream lines(content_of(directory.results() / "up.csv"));
  std::string absolute;
  for (std::string line; std::getline(lines, line);) {
    double time = 0.0, base = 0.0, relative = 0.0;
    absolute += std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &base, &relative) == 3
                    ? fmt::format("{},{},{}\n", time, base, base + relative)
                    : line + "\n";
  }
  directory.write("absolute.csv", absolute);
  const auto fitted = [&](const char* key) {
    directory.write(
        "case.toml",
        replaced(soft_case(),
                 "excitation = { type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", "
                 "duration = \"6 s\" }",
                 fmt::format("record = {{ file = \"absolute.csv\", from = \"10 Hz\", to = \"70 Hz\"{} }}", key)));
    EXPECT_EQ(run({"fit", directory.path().string()}).status, 0);
    return parsed(directory.results() / "fit.json");
  };
  const json right = fitted(", acceleration = \"absolute\"");
  EXPECT_EQ(right["verdict"], "sound") << right["reasons"];
  EXPECT_NEAR(right["parameters"][5]["estimate"].get<double>(), 40.0, 0.02);
  const json wrong = fitted("");
  EXPECT_EQ(wrong["verdict"], "questionable");
  EXPECT_NE(wrong["reasons"][0].get<std::string>().find("(absolute) acceleration"), std::string::npos);
}

TEST(MassMaterialProgram, ShakesWithAMeasuredBase) {
  const TemporaryCase directory(soft_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  fs::copy_file(directory.results() / "up.csv", directory.path() / "base.csv");
  const std::string text = replaced(
      soft_case(), "type = \"swept_sine\", level = \"2 g0\", from = \"10 Hz\", to = \"70 Hz\", duration = \"6 s\"",
      "type = \"measured\", file = \"base.csv\", from = \"10 Hz\", to = \"70 Hz\"");
  directory.write("case.toml", text);
  const fs::path again = directory.path() / "again";
  const Outcome outcome = run({"run", directory.path().string(), "--output", again.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const double first = parsed(directory.results() / "summary.json")["tests"][0]["peak_relative_displacement_m"];
  const double second = parsed(again / "summary.json")["tests"][0]["peak_relative_displacement_m"];
  EXPECT_NEAR(second, first, 1e-3 * first);
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

class BadMassMaterial : public testing::TestWithParam<BadInput> {};

TEST_P(BadMassMaterial, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(soft_case(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_inputs[] = {
    {"gram_for_gravity", "\"2 g0\"", "\"2 g\"", {"[test.excitation] level", "write g0 for multiples of gravity"}},
    {"unknown_structure", "\"2\"", "\"8\"", {"[model] structure: \"8\" is not a mass-material model"}},
    {"stiffness_of_wrong_order", "\"-1.0e6 N/m^2\"", "\"-1.0e6 N/m^3\"", {"stiffness[1]", "stiffness of second order"}},
    {"negative_stiffness", "\"54 kN/m\"", "\"-54 kN/m\"", {"stiffness[0]: k_1 must be positive"}},
    {"exponent_without_term",
     "damping = \"40 N s/m\"",
     "damping = \"40 N s/m\"\ndamping_exponent = 1.8",
     {"damping_exponent: model \"2\" has none"}},
    {"kernel_without_term",
     "damping = \"40 N s/m\"",
     "damping = \"40 N s/m\"\nkernel = [{ alpha = \"1 s^-1\", beta = \"1 N/m\" }]",
     {"model \"2\" has no kernel"}},
    {"no_mass", "mass = \"1.12 kg\"\n", "", {"\"mass\" is missing"}},
    {"unknown_excitation", "level = \"2 g0\"", "tpye = 1, level = \"2 g0\"", {"\"tpye\" is not known here"}},
    {"sampled_too_slowly",
     "\"1 kHz\"",
     "\"150 Hz\"",
     {"the excitation reaches 70 Hz; 150 samples per second resolve up to 57 Hz"}},
    {"two_tests_of_one_name", "name = \"down\"", "name = \"up\"", {"there are two tests \"up\""}},
    {"names_of_one_file",
     "name = \"down\"",
     "name = \"up_spectra\"",
     {"the tests \"up\" and \"up_spectra\" would have results in files of the same name"}},
    {"name_that_is_no_file",
     "name = \"down\"",
     "name = \"a/b\"",
     {"is used as the name of files; it may have letters, digits"}},
    {"unknown_key_of_fit", "replicates", "replicate", {"[fit] \"replicate\"", "did you mean \"replicates\"?"}},
};
INSTANTIATE_TEST_SUITE_P(Program, BadMassMaterial, testing::ValuesIn(bad_inputs),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(BadMassMaterial, FitWithoutRecords) {
  const TemporaryCase directory(soft_case());
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("pfdm run simulates one"), std::string::npos) << outcome.err;
}

TEST(BadMassMaterial, ModelThatDoesNotCarry) {
  const std::string text = replaced(replaced(soft_case(), "\"2\"", "\"4a\""), "damping = \"40 N s/m\"",
                                    "damping = \"40 N s/m\"\nkernel = [{ alpha = \"1 s^-1\", beta = \"-9e4 N/m/s\" }]");
  const TemporaryCase directory(text);
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("static stiffness"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
