// Cases of kind "endochronic" from end to end.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_case.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_case.h"
#include "tests/cases/temporary_case.h"
#include "tests/postproc/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pfdm::this_file {
namespace {

TEST(EndochronicCase, RunsAndWritesItsResults) {
  const TemporaryCase directory(tension_case());
  const Outcome outcome = run({"run", directory.path().string(), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable history = read_csv(directory.results() / "history.csv");
  ASSERT_EQ(history.n_rows(), 41u);
  EXPECT_NEAR(history.column("time_s").back(), 6.0, 1e-12);
  EXPECT_NEAR(history.column("strain_xx")[10], 0.01, 1e-14);
  EXPECT_NEAR(history.column("stress_yy_Pa")[10], 10e6, 1e-3);
  EXPECT_NEAR(history.column("strain_xy")[20], 0.01, 1e-14);  // gamma / 2
  EXPECT_NEAR(history.column("stress_xx_Pa")[15], 0.5e6, 1e-3);
  EXPECT_EQ(history.column("stress_zz_Pa").size(), 41u);
  EXPECT_TRUE(std::ranges::is_sorted(history.column("dissipation_J_per_m3")));
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_EQ(summary["status"], "complete");
  EXPECT_EQ(summary["steps"], 40);
  EXPECT_FALSE(summary.contains("peak_force_N"));
  EXPECT_LE(summary["largest_invariant_error_Pa"].get<double>(), 1e-2);
  EXPECT_NE(content_of(directory.results() / "run.log").find("complete"), std::string::npos);
}

TEST(EndochronicCase, StressBeyondSaturationEndsTheRunWithWhatThereIs) {
  const std::string no_rate =
      replaced(tension_case(), "law = \"logarithmic\"\nc = 0.1\nreference_rate = \"1e-4 1/s\"", "law = \"none\"");
  const TemporaryCase directory(replaced(no_rate, "strain_xx = \"1 %\"", "stress_xx = \"900 MPa\""));
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("beyond the saturation surface"), std::string::npos) << outcome.err;
  EXPECT_GT(read_csv(directory.results() / "history.csv").n_rows(), 1u);
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_EQ(summary["status"].get<std::string>().substr(0, 7), "failed:");
}

TEST(EndochronicCase, ChecksWithoutWritingAndHasNoMesh) {
  const TemporaryCase directory(tension_case());
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("4 segments, 40 increments"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(directory.results()));
  EXPECT_EQ(run({"mesh", directory.path().string()}).status, 2);
}

TEST(EndochronicCase, FollowsAColumnOfAFile) {
  // The file's own times, in another unit, and a strain in per cent.
  std::string text = tension_case();
  text.erase(text.find("[loading]"));
  text += R"([loading]
[[loading.segments]]
control = { strain_xx = { csv = "path.csv", column = "axial", unit = "percent", time = "t_ms", time_unit = "ms" } }
)";
  const TemporaryCase directory(text);
  directory.write("path.csv", "# synthetic\nt_ms, axial\n5,0\n15,0.5\n20,-0.25\n");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const CsvTable history = read_csv(directory.results() / "history.csv");
  ASSERT_EQ(history.n_rows(), 3u);
  EXPECT_NEAR(history.column("time_s")[2], 0.015, 1e-15);
  EXPECT_NEAR(history.column("strain_xx")[1], 0.005, 1e-15);
  EXPECT_NEAR(history.column("strain_xx")[2], -0.0025, 1e-15);
}

TEST(EndochronicCase, ReplacesEarlierResultsAsAWhole) {
  const TemporaryCase directory(tension_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ASSERT_EQ(run({"report", directory.path().string()}).status, 0);
  const std::string history = content_of(directory.results() / "history.csv");
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_TRUE(summary["newton_iterations"].is_number_integer());
  {
    const test::FileSizeLimit limit(history.size() / 2);
    EXPECT_EQ(run({"run", directory.path().string()}).status, 1);
  }
  EXPECT_EQ(content_of(directory.results() / "history.csv"), history);
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "report"));
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_NE(outcome.out.find("are complete: this run starts anew and replaces them"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(directory.results() / "report"));
  EXPECT_FALSE(std::filesystem::exists(directory.results() / ".new.partial"));
}

// What is loaded is what the results are of, however alike the material.
TEST(EndochronicCase, HashTellsLoadingsApart) {
  const TemporaryCase one(tension_case()), other(replaced(tension_case(), "\"1 %\"", "\"2 %\""));
  const TemporaryCase titled(replaced(tension_case(), "title = ", "# a comment\ntitle = "));
  const auto hash = [](const TemporaryCase& c) { return case_hash(open_case(c.path()), {}); };
  EXPECT_NE(hash(one), hash(other));
  EXPECT_EQ(hash(one), hash(titled));
}

constexpr const char* saturating_law = "law = \"saturating\"\nf_inf = 2.0\nb = 6.0";
constexpr const char* law_with_rate =
    "law = \"table_with_rate\"\nzeta = [0, 0.02]\nrate = [\"1e-4 1/s\", \"60 1/min\", \"2 1/s\"]\n"
    "f = [[1, 1.5], [1.1, 1.7], [1.2, 2]]";

void expect_to_be_read_again(const TemporaryCase& directory) {
  const auto read = [&] {
    return read_endochronic_law(
        open_case(directory.path()).config.root().with_keys(endochronic_case_keys()).table("material"));
  };
  const EndochronicLaw law = read();
  std::string text = "kind = \"endochronic\"\ntitle = \"again\"\n" + to_toml(law);
  directory.write("case.toml", text);
  const EndochronicLaw again = read();
  EXPECT_EQ(again.kernel, law.kernel);
  EXPECT_NEAR(again.elasticity.mu, law.elasticity.mu, 1e-14 * law.elasticity.mu);
  EXPECT_EQ(again.hardening.with_path.p, law.hardening.with_path.p);
  EXPECT_EQ(again.hardening.with_rate.p, law.hardening.with_rate.p);
  EXPECT_EQ(again.hardening.with_path.law, law.hardening.with_path.law);
  EXPECT_EQ(again.hardening.with_rate.law, law.hardening.with_rate.law);
}

TEST(EndochronicCase, MaterialIsWrittenAsItIsRead) {
  expect_to_be_read_again(TemporaryCase(tension_case()));
  const TemporaryCase with_rate(replaced(tension_case(), saturating_law, law_with_rate));
  EXPECT_EQ(run({"run", with_rate.path().string(), "--quiet"}).status, 0);
  EXPECT_EQ(run({"report", with_rate.path().string()}).status, 0);
  expect_to_be_read_again(with_rate);
}

class BadEndochronicCase : public testing::TestWithParam<BadInput> {};

TEST_P(BadEndochronicCase, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(tension_case(), GetParam().good, GetParam().bad));
  directory.write("falling.csv", "time_s,strain\n0,0\n1,0.01\n0.5,0.02\n");
  directory.write("rising.csv", "time_s,strain\n0,0\n1,0.01\n");
  directory.write("torn.csv", "time_s,strain\n0,0\n1,x\n");
  expect_refused(directory, GetParam());
}

constexpr const char* first_control = "strain_xx = \"1 %\", stress_yy = \"10 MPa\"";

const BadInput bad_inputs[] = {
    {"no_kernel",
     "kernel = [{ C = \"30 GPa\", alpha = 700 }]",
     "kernel = []",
     {"case.toml:4: [material] \"kernel\" needs"}},
    {"negative_C", "\"30 GPa\"", "\"-30 GPa\"", {"case.toml:7: [material.kernel] C: \"-30 GPa\" must be positive"}},
    {"C_without_unit", "\"30 GPa\"", "30e9", {"C: 30000000000 has no unit; expected a stress"}},
    {"negative_alpha", "alpha = 700", "alpha = -7", {"alpha: -7 must be zero or positive"}},
    {"misspelt_kernel_key", "alpha = 700", "alfa = 700", {"\"alfa\" is not known here; did you mean \"alpha\"?"}},
    {"poisson_ratio_beyond_the_limit",
     "poisson_ratio = 0.34",
     "poisson_ratio = 0.49995",
     {"poisson_ratio: 0.49995 must be above -1 and at most 0.4999"}},
    {"beta", "poisson_ratio = 0.34", "poisson_ratio = 0.34\nbeta = 2", {"beta: 2 must be between 0 and 1"}},
    {"unknown_hardening",
     "\"saturating\"",
     "\"saturated\"",
     {"is not a hardening law; did you mean \"saturating\"?", "table"}},
    {"hardening_without_parameter", "f_inf = 2.0\n", "", {"[material.hardening] \"f_inf\" is missing"}},
    {"parameter_of_another_law", "b = 6.0", "b = 6.0\nn = 1", {"[material.hardening] \"n\" is not known here"}},
    {"rate_of_another_dimension", "\"1e-4 1/s\"", "\"1e-4 s\"", {"is a time; expected a rate"}},
    {"table_of_hardening",
     "law = \"saturating\"\nf_inf = 2.0\nb = 6.0",
     "law = \"table\"\npoints = [[0, 1], [0, 2]]",
     {"case.toml:9: [material.hardening] zeta must increase"}},
    {"table_with_rate_of_unequal_rows",
     saturating_law,
     "law = \"table_with_rate\"\nzeta = [0, 1]\nrate = [\"1 1/s\", \"2 1/s\"]\nf = [[1, 1], [1, 1, 1]]",
     {"[material.hardening] f"}},
    {"table_with_rate_whose_rates_fall",
     saturating_law,
     "law = \"table_with_rate\"\nzeta = [0, 1]\nrate = [\"2 1/s\", \"1 1/s\"]\nf = [[1, 1], [1, 1]]",
     {"[material.hardening] the rate must increase"}},
    {"unknown_component",
     "strain_xx = \"1 %\"",
     "strain_xz_ = 1",
     {"\"strain_xz_\" is not a component", "did you mean \"strain_xz\"?"}},
    {"strain_as_stress",
     "strain_xx = \"1 %\"",
     "strain_xx = \"1 MPa\"",
     {"\"1 MPa\" is a stress; expected a number without a unit"}},
    {"stress_without_unit", "stress_yy = \"10 MPa\"", "stress_yy = 10", {"stress_yy: 10 has no unit"}},
    {"seven_conditions",
     first_control,
     "strain_xx = 0.01, stress_xx = \"1 MPa\"",
     {"case.toml:22: [loading.segments] expected 6 conditions on stress and strain, found 7", "free = ["}},
    {"five_conditions",
     "control = { strain_xx = \"1 %\"",
     "free = [\"zz\"]\ncontrol = { strain_xx = \"1 %\"",
     {"expected 6 conditions on stress and strain, found 5"}},
    {"dependent_conditions",
     "strain_xx = \"1 %\", stress_yy = \"10 MPa\" }",
     "strain_xy = 0.01, gamma_xy = 0.02 }\nfree = [\"xx\"]",
     {"not independent (rank 5 of 6)"}},
    {"expression", "\"0.01*t\"", "\"0.01*q\"", {"the expression \"0.01*q\" cannot be read"}},
    {"stress_expression_without_unit",
     "stress_yy = \"10 MPa\"",
     "stress_yy = { expr = \"t\" }",
     {"\"unit\" is missing"}},
    {"times_that_fall", "[\"0 s\", \"0 MPa\"]", "[\"3 s\", \"0 MPa\"]", {"the times must increase"}},
    {"table_too_short", "[\"2 s\", \"1 MPa\"]", "[\"1 s\", \"1 MPa\"]", {"the segment lasts 2 s, the data end at 1 s"}},
    {"no_segments",
     "[[loading.segments]]\nduration = \"1 s\"",
     "[[loading.segment]]\nduration = \"1 s\"",
     {"\"segment\" is not known here; did you mean \"segments\"?"}},
    {"no_increments",
     "duration = \"1 s\"\nincrements = 10",
     "duration = \"1 s\"\nincrements = 0",
     {"increments: 0 must be at least 1 and at most 10000000"}},
    {"no_file",
     "strain_xx = \"1 %\"",
     "strain_xx = { csv = \"no.csv\", column = \"strain\" }",
     {"csv: cannot read", "no.csv"}},
    {"no_column",
     "strain_xx = \"1 %\"",
     "strain_xx = { csv = \"rising.csv\", column = \"stress\" }",
     {"there is no column \"stress\""}},
    {"file_with_falling_times",
     "strain_xx = \"1 %\"",
     "strain_xx = { csv = \"falling.csv\", column = \"strain\" }",
     {"must increase; they do not at row 3"}},
    {"file_with_words",
     "strain_xx = \"1 %\"",
     "strain_xx = { csv = \"torn.csv\", column = \"strain\" }",
     {"torn.csv, line 3: \"x\" in column \"strain\" is not a number"}},
};

INSTANTIATE_TEST_SUITE_P(EndochronicProgram, BadEndochronicCase, testing::ValuesIn(bad_inputs),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace pfdm::this_file
