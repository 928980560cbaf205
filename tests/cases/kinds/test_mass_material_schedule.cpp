// Cases of kind mass_material with a schedule: spread between repeats, drift, the table of tests.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/vibration/mass_material_case.h"
#include "tests/cases/soft_sample.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

using nlohmann::json;

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

}  // namespace
}  // namespace pfdm::this_file
