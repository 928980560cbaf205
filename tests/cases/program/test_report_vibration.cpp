// pfdm report of cases of kind mass_material; of cases of all kinds without results, or with later ones.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/vibration/mass_material_report.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_case.h"
#include "tests/cases/report_blocks.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string sweep_case() {
  return R"(kind = "mass_material"
title = "a soft sample"
[model]
structure = "1"
mass = "1.12 kg"
stiffness = ["54 kN/m"]
damping = "40 N s/m"
[sample]
length = "76.2 mm"
area = "45.6 cm^2"
[sampling]
rate = "1 kHz"
[[test]]
name = "low"
excitation = { type = "random", density = "0.001 g0^2/Hz", from = "10 Hz", to = "100 Hz", duration = "60 s", seed = 1 }
[[test]]
name = "high"
excitation = { type = "random", density = "0.01 g0^2/Hz", from = "10 Hz", to = "100 Hz", duration = "60 s", seed = 2 }
[fit]
replicates = 20
)";
}

ReportPage page_of_sweep(const TemporaryCase& directory) {
  const CaseFile file = open_case(directory.path());
  MassMaterialProgram program{
      .file = file, .parsed = read_mass_material_case(file.config.root(), file.directory), .name = "sweep", .hash = {}};
  program.hash = case_hash(file, program.parsed.data_files);
  std::ostringstream said;
  Log log(said, said, false, true);
  Session session{
      .results = directory.results(), .max_steps = std::nullopt, .until = std::nullopt, .version = "test", .log = log};
  return mass_material_page(program, session);
}

TEST(Report, TellsOfAVibrationTest) {
  const TemporaryCase directory(sweep_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  ReportPage page = page_of_sweep(directory);
  EXPECT_THAT(page.subtitle, HasSubstr("synthetic"));
  EXPECT_EQ(row_of(block<Table>(page, "Sample and conditions"), "shown below"), "high");
  EXPECT_EQ(row_of(block<Table>(page, "Model 1"), "k1 [N/m]"), "54000");
  const Chart magnitude = block<Chart>(page, "H1, base to relative acceleration");
  ASSERT_EQ(magnitude.series.size(), 3u);
  EXPECT_EQ(magnitude.series[2].label, "model of the case");
  // |z''/y''| of a mass on spring and damper, m omega^2 / |k + i omega c - m omega^2|.
  const Series& recorded = magnitude.series[1];
  for (std::size_t i = 0; i < recorded.x.size(); ++i) {
    if (recorded.x[i] < 15.0 || recorded.x[i] > 90.0) continue;
    const double w = 2.0 * M_PI * recorded.x[i];
    const double H = 1.12 * w * w / std::hypot(54e3 - 1.12 * w * w, 40.0 * w);
    EXPECT_NEAR(recorded.y[i], H, 0.02 * H) << recorded.x[i];
    EXPECT_NEAR(magnitude.series[2].y[i], recorded.y[i], 1e-3 * H);
  }
  const Chart phase = block<Chart>(page, "H1: phase");
  EXPECT_GT(phase.series[0].y.front(), -30.0);
  EXPECT_LT(phase.series[0].y.back(), -140.0);
  const Chart densities = block<Chart>(page, "Spectral densities");
  EXPECT_EQ(densities.y.title, "density [g0²/Hz]");
  EXPECT_NEAR(densities.series[0].y[densities.series[0].y.size() / 2], 0.01, 0.005);
  EXPECT_GT(block<Chart>(page, "Coherence").series[0].y[100], 0.99);
  EXPECT_EQ(block<Chart>(page, "Base").y.title, "acceleration [g0]");
  EXPECT_EQ(block<Chart>(page, "About the largest response").series.size(), 2u);

  ASSERT_EQ(run({"fit", directory.path().string()}).status, 0);
  const Outcome outcome = run({"report", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_files(directory.results());
  page = page_of_sweep(directory);
  EXPECT_EQ(block<Chart>(page, "H1: phase").series[1].label, "identified model");
  EXPECT_THAT(row_of(block<Table>(page, "Model 1"), "k1 [N/m]"), HasSubstr(" to "));
  EXPECT_THAT(row_of(block<Table>(page, "Tests"), "low"), HasSubstr("fitted"));
  EXPECT_EQ(block<Chart>(page, "Young's modulus").series.size(), 2u);
}

TEST(Report, SaysWhatItHasNothingToDrawFrom) {
  for (const std::string& text : {bar_case(), tension_case(), sweep_case()}) {
    const TemporaryCase directory(text);
    const Outcome outcome = run({"report", directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("pfdm run"));
    EXPECT_FALSE(fs::exists(directory.results() / "report"));
  }
}

TEST(Report, GoesWithTheRunThatItTellsOf) {
  for (const std::string& text : {bar_case(), tension_case(), sweep_case()}) {
    const TemporaryCase directory(text);
    ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
    ASSERT_EQ(run({"report", directory.path().string()}).status, 0);
    ASSERT_TRUE(fs::exists(directory.results() / "report" / "report.pdf"));
    ASSERT_TRUE(fs::exists(directory.results() / "report" / "index.html"));
    ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
    EXPECT_FALSE(fs::exists(directory.results() / "report" / "report.pdf"));
    EXPECT_FALSE(fs::exists(directory.results() / "report" / "report.png"));
    EXPECT_FALSE(fs::exists(directory.results() / "report" / "index.html"));
  }
}

}  // namespace
}  // namespace pfdm::this_file
