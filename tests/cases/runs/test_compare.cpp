// pfdm compare from end to end, on a bar that breaks.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

nlohmann::json json_in(const fs::path& file) { return nlohmann::json::parse(content_of(file)); }

/// What a run of the case made, in micrometres and kilonewtons, its forces times a factor.
std::string measured(const fs::path& results, double factor) {
  const CsvTable curve = read_csv(results / "force_displacement.csv");
  std::string text = "# made by the test\nu,f\n";
  for (std::size_t i = 0; i < curve.n_rows(); ++i)
    text += std::to_string(1e6 * curve.column("displacement_m")[i]) + "," +
            std::to_string(1e-3 * factor * curve.column("force_x_N")[i]) + "\n";
  return text;
}

TEST(Compare, FindsNoDifferenceFromItself) {
  const TemporaryCase directory(bar_case());
  fs::create_directory(directory.path() / "data");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  directory.write("data/one.csv", measured(directory.results(), 1.0));
  directory.write("case.toml", bar_case() + measured_specimen());  // after the run: its results stay valid
  const Outcome outcome = run({"compare", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json force = json_in(directory.results() / "comparison.json")["force_displacement"];
  EXPECT_LT(force["rms_difference_over_largest_measured"].get<double>(), 1e-4);
  for (const char* figure : {"initial_stiffness", "peak_force", "displacement_at_peak", "work"})
    EXPECT_NEAR(force["relative_difference"][figure].get<double>(), 0.0, 2e-4) << figure;
  EXPECT_TRUE(force["share_within_two_standard_deviations"].is_null());
  EXPECT_EQ(read_csv(directory.results() / "comparison.csv").n_rows(), 401u);
}

TEST(Compare, TakesTheBandFromSpecimensAndFromTheirDeviation) {
  const TemporaryCase directory(bar_case());
  fs::create_directory(directory.path() / "data");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  directory.write("data/one.csv", measured(directory.results(), 1.1));
  directory.write("data/two.csv", measured(directory.results(), 0.9));
  std::string second = measured_specimen();
  second.erase(0, second.find("[[experiment"));
  second = replaced(replaced(second, "\"one\"", "\"two\""), "data/one.csv", "data/two.csv");
  directory.write("case.toml", bar_case() + measured_specimen() + second);
  ASSERT_EQ(run({"compare", directory.path().string()}).status, 0);
  nlohmann::json force = json_in(directory.results() / "comparison.json")["force_displacement"];
  EXPECT_NEAR(force["share_within_two_standard_deviations"].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(force["relative_difference"]["peak_force"].get<double>(), 0.0, 1e-3);
  EXPECT_EQ(force["specimens"].size(), 2u);

  // 10 % off with a standard deviation of 1 %.
  std::string with_deviation = "u,f,s\n0,0,0\n";
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  for (std::size_t i = 1; i < curve.n_rows(); ++i) {
    const double f = 1.1e-3 * curve.column("force_x_N")[i];
    with_deviation += std::to_string(1e6 * curve.column("displacement_m")[i]) + "," + std::to_string(f) + "," +
                      std::to_string(0.01 * f) + "\n";
  }
  directory.write("data/one.csv", with_deviation);
  directory.write("case.toml", bar_case() + measured_specimen() + "deviation = { column = \"s\", unit = \"kN\" }\n");
  ASSERT_EQ(run({"compare", directory.path().string()}).status, 0);
  force = json_in(directory.results() / "comparison.json")["force_displacement"];
  EXPECT_LT(force["share_within_two_standard_deviations"].get<double>(), 0.2);
  EXPECT_NEAR(force["relative_difference"]["initial_stiffness"].get<double>(), 1.0 / 1.1 - 1.0, 1e-3);
}

// The computed curve, recorded by a soft machine with an offset, with a loop and jitter, in kN and um by semicolons.
TEST(Compare, PreparesWhatAMachineRecords) {
  const TemporaryCase directory(bar_case());
  fs::create_directory(directory.path() / "data");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  const double compliance = 0.4 * curve.column("displacement_m")[1] / curve.column("force_x_N")[1];
  std::string text = "Weg [um];Kraft\n;[kN]\n";
  const auto add = [&](double u, double F) {
    text += fmt::format("{:.9g};{:.12g}\n", 1e6 * u + 3.0, 1e-3 * F + 0.001);
  };
  double last = 0.0;
  for (std::size_t i = 0; i < curve.n_rows(); ++i) {
    const double F = curve.column("force_x_N")[i], u = curve.column("displacement_m")[i] + compliance * F;
    if (u < last) break;  // the bar has broken, which the machine would not follow back
    if (i == 5) {
      add(0.5 * last, 0.3 * F);
      add(0.7 * last, 0.5 * F);
    }
    add(u, F);
    last = u;
  }
  std::ranges::replace(text, '.', ',');
  directory.write("data/one.csv", text);
  std::string experiment = replaced(measured_specimen("[\"4 um\", \"9 um\"]"), "{ column = \"u\", unit = \"um\" }",
                                    "{ column = \"Weg [um]\", unit = \"um\" }");
  experiment = replaced(experiment, "{ column = \"f\", unit = \"kN\" }", "{ column = \"Kraft\" }");
  experiment += fmt::format(
      "loops = \"envelope\"\noffset = \"3 um\"\nforce_offset = \"1 N\"\ncompliance = \"{} m/N\"\n", compliance);
  directory.write("case.toml", bar_case() + experiment);
  const Outcome outcome = run({"compare", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("one: unloading loops: 2 of"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("the straight part"), std::string::npos) << outcome.out;
  const auto force = json_in(directory.results() / "comparison.json")["force_displacement"];
  EXPECT_LT(force["rms_difference_over_largest_measured"].get<double>(), 1e-3);
  EXPECT_NEAR(force["relative_difference"]["initial_stiffness"].get<double>(), 0.0, 1e-3);
  EXPECT_EQ(force["specimens"][0]["preparation"].size(), 4u);
  EXPECT_EQ(run({"report", directory.path().string()}).status, 0);

  directory.write("case.toml", replaced(bar_case() + experiment, "offset = \"3 um\"\n", ""));
  const Outcome late = run({"compare", directory.path().string()});
  EXPECT_NE((late.out + late.err).find("the straight part of one meets zero force at 3 um"), std::string::npos)
      << late.out << late.err;
}

class BadExperiment : public testing::TestWithParam<BadInput> {};

TEST_P(BadExperiment, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(bar_case() + measured_specimen(), GetParam().good, GetParam().bad));
  fs::create_directory(directory.path() / "data");
  directory.write("data/one.csv", "u,f,back,none\n0,0,0,0\n5,1,2,0\n10,1.5,1,0\n");
  expect_refused(directory, GetParam());
}

const BadInput bad_experiments[] = {
    {"file_that_is_not_there", "data/one.csv", "data/won.csv", {"case.toml:54: [experiment.specimens] csv", "won.csv"}},
    {"column_that_is_not_there", "\"f\"", "\"g\"", {"there is no column \"g\" (available: u, f, back, none)"}},
    {"unit_of_another_dimension", "\"kN\"", "\"kPa\"", {"is a stress; expected a force"}},
    {"displacements_that_fall", "column = \"u\"", "column = \"back\"", {"the displacements decrease"}},
    {"name_that_is_empty", "name = \"one\"", "name = \"\"", {"[experiment.specimens] name: the name is empty"}},
    {"name_of_two_specimens",
     "[[experiment.specimens]]",
     "[[experiment.specimens]]\nname = \"one\"\ncsv = \"data/one.csv\"\ndisplacement = { column = 1, unit = "
     "\"um\" }\nforce = { column = 2, unit = \"kN\" }\n[[experiment.specimens]]",
     {"another specimen is called \"one\" already"}},
    {"forces_that_are_all_zero", "\"f\"", "\"none\"", {"force: all forces are zero; there is nothing to compare with"}},
    {"column_beyond_the_last", "\"f\"", "5", {"force] column: the file has 4 columns (u, f, back, none)"}},
    {"separator_that_is_none", "name = \"one\"", "name = \"one\"\nseparator = \"|\"", {"(allowed: ,, ;, tab, blank)"}},
    {"comma_for_both",
     "name = \"one\"",
     "name = \"one\"\nseparator = \",\"\ndecimal = \",\"",
     {"a comma cannot separate entries and be the decimal mark"}},
    {"jitter_without_unit", "name = \"one\"", "name = \"one\"\njitter = 0.1", {"jitter: 0.1 has no unit"}},
    {"jitter_too_small",
     "column = \"u\"",
     "column = \"back\"",
     {"set loops = \"envelope\" to leave unloading out, or jitter to the largest noise"}},
    {"unknown_loops",
     "name = \"one\"",
     "name = \"one\"\nloops = \"follow\"",
     {"\"follow\" is not a treatment of unloading loops (allowed: envelope)"}},
    {"toe_of_one_end", "name = \"one\"", "name = \"one\"\ntoe = [\"1 N\"]", {"toe"}},
    {"toe_that_falls", "name = \"one\"", "name = \"one\"\ntoe = [\"2 N\", \"1 N\"]", {"must be the larger"}},
    {"toe_of_two_dimensions",
     "name = \"one\"",
     "name = \"one\"\ntoe = [\"2 N\", \"3 um\"]",
     {"toe[1]: \"3 um\" is a length"}},
    {"toe_without_rows",
     "name = \"one\"",
     "name = \"one\"\ntoe = [\"9 kN\", \"10 kN\"]",
     {"toe: 0 rows lie between 9 and 10 kN"}},
    {"compliance_below_zero",
     "name = \"one\"",
     "name = \"one\"\ncompliance = \"-1 um/N\"",
     {"must be zero or positive"}},
    {"compliance_as_stiffness",
     "name = \"one\"",
     "name = \"one\"\ncompliance = \"1 N/um\"",
     {"expected a compliance, as in \"2 um/kN\""}},
    {"misspelt_preparation",
     "name = \"one\"",
     "name = \"one\"\ncomplience = \"1 um/N\"",
     {"did you mean \"compliance\"?"}},
    {"range_that_is_empty", "[\"1 um\", \"5 um\"]", "[\"5 um\", \"1 um\"]", {"must be the larger"}},
    {"range_without_unit", "[\"1 um\", \"5 um\"]", "[1, 5]", {"has no unit"}},
    {"misspelt_key", "stiffness_between", "stiffness_betwen", {"did you mean \"stiffness_between\"?"}},
};
INSTANTIATE_TEST_SUITE_P(Inputs, BadExperiment, testing::ValuesIn(bad_experiments),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Compare, RefusesWhatCannotBeCompared) {
  const TemporaryCase directory(bar_case() + measured_specimen());
  fs::create_directory(directory.path() / "data");
  directory.write("data/one.csv", "u,f\n0,0\n5,1\n");
  const auto expect = [&](const std::string& message) {
    const Outcome outcome = run({"compare", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect("there are no results; pfdm run makes them");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  directory.write("data/one.csv", "u,f\n500,0\n600,1\n");
  expect("no range is common");
  directory.write("data/one.csv", "u,f\n5,1\n");
  expect("fewer than two points");
  directory.write("data/one.csv", "u,f\n0,0\n3,1\n");
  expect("the stiffness is requested between 1 and 5 um");
}

}  // namespace
}  // namespace pfdm::this_file
