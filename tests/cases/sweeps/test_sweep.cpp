// pfdm sweep, on a bar that breaks and on a material point.

#include "cases/program/studies/sweep/shown_columns.h"
#include "cases/program/studies/sweep/sweep_case.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

std::string sweep(const std::string& method, const std::string& of_modulus, const std::string& of_toughness) {
  return "\n[sweep]\n" + method + "\n[[sweep.parameters]]\nkey = \"materials.concrete.young_modulus\"\n" + of_modulus +
         "\n[[sweep.parameters]]\nkey = [\"materials.concrete.toughness\", \"regions.weak.toughness\"]\n" +
         of_toughness + "\n";
}

const std::string grid = sweep("method = \"grid\"", "values = [\"30 GPa\", \"40 GPa\"]",
                               "between = [\"50 J/m^2\", \"200 J/m^2\"]\ncount = 3\nspacing = \"logarithmic\"");

constexpr const char* modulus_column = "materials.concrete.young_modulus_Pa";
constexpr const char* toughness_column = "materials.concrete.toughness_J_per_m2";

TEST(Sweep, RunsAGridIntoOneTable) {
  const TemporaryCase directory(bar_case() + grid);
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("6 runs made, 0 reused"), std::string::npos) << outcome.out;
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  ASSERT_EQ(table.n_rows(), 6u);
  EXPECT_EQ(table.column(modulus_column), (std::vector<double>{30e9, 30e9, 30e9, 40e9, 40e9, 40e9}));
  EXPECT_NEAR(table.column(toughness_column)[1], 100.0, 1e-9);
  EXPECT_EQ(table.column("converged"), std::vector<double>(6, 1.0));
  for (std::size_t i = 0; i < 6; ++i) {
    const double E = table.column(modulus_column)[i], Gc = table.column(toughness_column)[i];
    // Steps of a tenth of the load tell the peak as well as they can; the bar is held on all sides.
    const double strength = std::sqrt(3.0 * (E / 0.9) * 0.8 * Gc / (8.0 * 4e-3)) * 1e-6;
    EXPECT_NEAR(table.column("peak_force_N")[i], strength, 0.25 * strength);
    EXPECT_NEAR(table.column("initial_stiffness_N_per_m")[i], E / 0.9 * 1e-6 / 0.02, 1e-5 * E * 1e-6 / 0.02);
  }
  EXPECT_EQ(std::ranges::count(table.names, "wall_seconds"), 0);
  // The first of the grid is the case itself: the table tells the same as a run.
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  EXPECT_EQ(table.column("peak_force_N")[1], std::ranges::max(curve.column("force_x_N")));
}

TEST(Sweep, GoesOnWithTheRunsThatAreThere) {
  const TemporaryCase directory(bar_case() + grid);
  ASSERT_EQ(run({"sweep", directory.path().string()}).status, 0);
  const std::string table = content_of(directory.results() / "sweep.csv");
  // As if killed: two runs are missing, one of them stopped on its way.
  auto runs = fs::directory_iterator(directory.results() / "runs");
  fs::remove_all(runs->path());
  fs::remove((++runs)->path() / "summary.json");
  const Outcome outcome = run({"sweep", directory.path().string(), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 runs made, 4 reused"), std::string::npos) << outcome.out;
  EXPECT_EQ(content_of(directory.results() / "sweep.csv"), table);
}

TEST(Sweep, TellsOfRunsThatDoNotConverge) {
  const std::string few = "[solver]\nmaximum_iterations = 4\n";
  std::string text = replaced(bar_case(), "initial_increment", "minimum_increment = 0.05\ninitial_increment");
  text += sweep("method = \"list\"", "values = [\"30 GPa\", \"10 GPa\"]", "values = [\"100 J/m^2\", \"200 J/m^2\"]");
  const TemporaryCase directory(text + few);
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 of them did not converge"), std::string::npos) << outcome.out;
  const std::string table = content_of(directory.results() / "sweep.csv");
  EXPECT_NE(table.find("# run 1: step "), std::string::npos) << table;
  EXPECT_NE(table.find("# run 2: runs/"), std::string::npos) << table;
  EXPECT_NE(table.find("nan"), std::string::npos) << table;
}

TEST(Sweep, ChangesTheMeshAsWell) {
  const TemporaryCase directory(bar_case() + R"(
[sweep]
method = "grid"
[[sweep.parameters]]
key = "mesh.x[0].cells"
values = [21, 31, 41]
)");
  ASSERT_EQ(run({"sweep", directory.path().string()}).status, 0);
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  EXPECT_EQ(table.column("cells"), (std::vector<double>{42.0, 62.0, 82.0}));
}

TEST(Sweep, OfNoRunThatEndsFails) {
  const TemporaryCase directory(bar_case() + sweep("method = \"list\"", "values = [\"-30 GPa\", \"-10 GPa\"]",
                                                   "values = [\"100 J/m^2\", \"200 J/m^2\"]"));
  const Outcome outcome = run({"sweep", directory.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("none of the 2 runs of the sweep came to its end; run 1: "), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("young_modulus: \"-30 GPa\" must be positive"), std::string::npos) << outcome.err;
}

TEST(Sweep, RunsCasesOfAnotherKind) {
  const TemporaryCase directory(R"(kind = "endochronic"
title = "cycles"
[material]
young_modulus = "100 GPa"
poisson_ratio = 0.3
kernel = [{ C = "30 GPa", alpha = 700 }]
[loading]
[[loading.segments]]
duration = "1 s"
increments = 20
control = { strain_xx = 0.005 }
[sweep]
method = "grid"
[[sweep.parameters]]
key = "material.kernel[0].alpha"
values = [500, 700]
)");
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(read_csv(directory.results() / "sweep.csv").column("material.kernel[0].alpha"),
            (std::vector<double>{500.0, 700.0}));
}

TEST(Sweep, SamplesEachIntervalOnce) {
  const auto points = latin_hypercube(50, 3, 4);
  ASSERT_EQ(points.size(), 50u);
  for (std::size_t j = 0; j < 3; ++j) {
    std::set<int> intervals;
    for (const auto& point : points) intervals.insert(static_cast<int>(point[j] * 50.0));
    EXPECT_EQ(intervals.size(), 50u);
  }
  EXPECT_EQ(latin_hypercube(50, 3, 4), points);
  EXPECT_NE(latin_hypercube(50, 3, 5), points);
}

TEST(Sweep, RunsASample) {
  const TemporaryCase directory(bar_case() + sweep("method = \"latin_hypercube\"\nsamples = 4",
                                                   "between = [\"20 GPa\", \"40 GPa\"]",
                                                   "between = [\"50 J/m^2\", \"200 J/m^2\"]"));
  ASSERT_EQ(run({"sweep", directory.path().string()}).status, 0);
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  std::vector<double> moduli = table.column(modulus_column);
  std::ranges::sort(moduli);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GE(moduli[i], 20e9 + 5e9 * static_cast<double>(i));
    EXPECT_LE(moduli[i], 25e9 + 5e9 * static_cast<double>(i));
  }
}

// A word, a truth value and a number at once; a report has the words.
TEST(Sweep, ChangesWordsAsWell) {
  const std::string words = R"(
[sweep]
method = "grid"
[[sweep.parameters]]
key = "fracture.model"
values = ["AT1", "AT2"]
[[sweep.parameters]]
key = "materials.concrete.young_modulus"
values = ["30 GPa", "40 GPa"]
[[sweep.parameters]]
key = "materials.concrete.damageable"
values = [true]
)";
  const std::string damageable = "poisson_ratio = 0.2\ndamageable = true";
  const TemporaryCase directory(replaced(bar_case(), "poisson_ratio = 0.2", damageable) + words);
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  EXPECT_EQ(table.column("fracture.model"), (std::vector<double>{0.0, 0.0, 1.0, 1.0}));
  EXPECT_EQ(std::ranges::count(table.comments, "fracture.model, 1: AT2"), 1)
      << content_of(directory.results() / "sweep.csv");
  // Strength over (E Gc/length)^(1/2): (3/8)^(1/2) and 3/16 3^(1/2); steps of a tenth of the load tell it roughly.
  const std::vector<double>& peak = table.column("peak_force_N");
  EXPECT_NEAR(peak[2] / peak[0], 0.3248 / 0.6124, 0.12);
  for (const std::size_t i : {0u, 2u}) EXPECT_NEAR(peak[i + 1] / peak[i], std::sqrt(4.0 / 3.0), 0.1);
  EXPECT_TRUE(fs::exists(directory.results() /
                         "runs_by_value/model=AT2,concrete.young_modulus=40GPa,concrete.damageable=true"));
  const Outcome report = run({"report", directory.path().string()});
  ASSERT_EQ(report.status, 0) << report.err;
  EXPECT_NE(content_of(directory.results() / "report/index.html").find("AT2"), std::string::npos);
}

// The case that runs with "0 mm" holds a number there. Titles that differ by signs alone have links of their own, and a
// blank one has its row in the report.
TEST(Sweep, TakesWordsBesideQuantitiesAndOddOnes) {
  const std::string words = R"(
[sweep]
method = "list"
[[sweep.parameters]]
key = "boundary[0].displacement[1]"
values = ["free", "0 mm", "free", "free"]
[[sweep.parameters]]
key = "title"
values = ["a*b", "a/b", "a/b", " "]
)";
  const TemporaryCase directory(bar_case() + words);
  const Outcome outcome = run({"sweep", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  EXPECT_EQ(table.column("converged"), std::vector<double>(4, 1.0)) << content_of(directory.results() / "sweep.csv");
  EXPECT_EQ(std::ranges::count(table.comments, "boundary[0].displacement[1], 1: 0 mm"), 1);
  EXPECT_TRUE(fs::exists(directory.results() / "runs_by_value/displacement_1=free,title=a_b"));
  EXPECT_TRUE(fs::exists(directory.results() / "runs_by_value/displacement_1=0mm,title=a_b"));
  EXPECT_TRUE(fs::exists(directory.results() / "runs_by_value/run_3"));
  const Outcome report = run({"report", directory.path().string()});
  EXPECT_EQ(report.status, 0) << report.err;
}

TEST(Sweep, ColumnsHaveUnitsAndAxesShortTitles) {
  const ShownColumn work = shown_column("dissipation_J_per_m3", {3.8e6});
  EXPECT_EQ(work.title(), "dissipation [MJ/m³]");
  EXPECT_DOUBLE_EQ(work.values[0], 3.8);
  ShownColumn word = shown_column("split", {0.0, 1.0});
  word.names = {"none", "star_convex"};
  EXPECT_EQ(word.title(), "split (0 none, 1 star_convex)");
  word.names[1] = std::string(60, 'x');
  EXPECT_EQ(word.title(), "split (values 0, 1, ... of the list)");
}

class BadSweep : public testing::TestWithParam<BadInput> {};

TEST_P(BadSweep, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(bar_case() + grid, GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_sweeps[] = {
    {"unknown_method", "\"grid\"", "\"gird\"", {"[sweep] method", "did you mean \"grid\"?"}},
    {"list_of_unequal_lengths",
     "\"grid\"",
     "\"list\"",
     {"a list needs equally many values of each parameter; found 2 and 3"}},
    {"sample_without_a_range",
     "\"grid\"",
     "\"latin_hypercube\"\nsamples = 3",
     {"[sweep.parameters] \"between\" is missing"}},
    {"value_without_unit", "[\"30 GPa\", \"40 GPa\"]", "[30, 40]", {"values[0]: 30 has no unit; expected a stress"}},
    {"no_values", "values = [\"30 GPa\", \"40 GPa\"]\n", "", {"\"values\" is missing, or \"between\" with \"count\""}},
    {"range_that_falls", "[\"50 J/m^2\", \"200 J/m^2\"]", "[\"50 J/m^2\", \"20 J/m^2\"]", {"must be the larger"}},
    {"misspelt_key", "spacing", "spacings", {"did you mean \"spacing\"?"}},
    {"memory_without_unit",
     "method = \"grid\"",
     "method = \"grid\"\nslurm = { memory = \"4\" }",
     {"[sweep.slurm] memory", "\"4\" is not an amount of memory", "as in \"4 GB\""}},
    {"time_limit_that_is_a_length",
     "method = \"grid\"",
     "method = \"grid\"\nslurm = { time = \"4 m\" }",
     {"[sweep.slurm] time"}},
    {"unknown_option_of_slurm",
     "method = \"grid\"",
     "method = \"grid\"\nslurm = { partitions = \"long\" }",
     {"did you mean \"partition\"?"}},
    {"key_that_is_named_twice",
     "[\"materials.concrete.toughness\", \"regions.weak.toughness\"]",
     "\"materials.concrete.young_modulus\"",
     {"[sweep.parameters] key: \"materials.concrete.young_modulus\" is named twice"}},
    {"words_between_two",
     "\"grid\"\n[[sweep.parameters]]",
     "\"grid\"\n[[sweep.parameters]]\nkey = \"fracture.model\"\nbetween = [\"AT1\", \"AT2\"]\n[[sweep.parameters]]",
     {"[sweep.parameters] key: its value is no number: \"values\" has to list what it takes"}},
    {"numbers_for_words",
     "\"grid\"\n[[sweep.parameters]]",
     "\"grid\"\n[[sweep.parameters]]\nkey = \"fracture.model\"\nvalues = [1, 2]\n[[sweep.parameters]]",
     {"[sweep.parameters] values[0]", "expected a text"}},
    {"words_of_two_lines",
     "\"grid\"\n[[sweep.parameters]]",
     "\"grid\"\n[[sweep.parameters]]\nkey = \"title\"\nvalues = [\"a\\nb\"]\n[[sweep.parameters]]",
     {"[sweep.parameters] values[0]: expected a text of one line"}},
    {"word_and_number_as_one",
     "\"grid\"\n[[sweep.parameters]]",
     "\"grid\"\n[[sweep.parameters]]\nkey = [\"title\", \"materials.concrete.poisson_ratio\"]\n"
     "values = [\"a\"]\n[[sweep.parameters]]",
     {"\"materials.concrete.poisson_ratio\" and \"title\" hold values of different types"}},
    {"element_that_is_not_there",
     "\"materials.concrete.young_modulus\"",
     "\"mesh.x[1].cells\"",
     {"\"mesh.x\" has 1 elements, of which the first is [0]; there is no [1]"}},
};
INSTANTIATE_TEST_SUITE_P(Inputs, BadSweep, testing::ValuesIn(bad_sweeps),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
