// pfdm report: what the page of a fracture and of a material point tells, and that the files are made.

#include "cases/program/fracture/page/fracture_report.h"
#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_report.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/endochronic_case.h"
#include "tests/cases/report_blocks.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

ReportPage page_of_fracture(const TemporaryCase& directory) {
  const CaseFile file = open_case(directory.path());
  const FractureCase fracture = read_fracture_case(file.config.root(), file.directory);
  const auto experiment = read_experiment(file.config.root(), file.directory);
  const std::string hash = read_run_summary(directory.results() / summary_file).case_hash;
  return fracture_page(fracture, experiment, case_name(file), hash, directory.results());
}

TEST(Report, TellsOfAFracture) {
  const TemporaryCase directory(bar_case() + crack_plane() + measured_specimen() +
                                "deviation = { column = \"s\", unit = \"N\" }\n");
  fs::create_directories(directory.path() / "data");
  directory.write("data/one.csv", "u,f,s\n0,0,1\n15,0.002,1\n");
  const Outcome ran = run({"run", directory.path().string()});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Outcome outcome = run({"report", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("report.pdf"));
  expect_files(directory.results());

  const ReportPage page = page_of_fracture(directory);
  EXPECT_THAT(page.title, HasSubstr("a bar"));
  EXPECT_THAT(page.subtitle, HasSubstr("complete"));
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  const Chart force = block<Chart>(page, "Force against displacement");
  EXPECT_EQ(force.x.title, "displacement x of xmax [µm]");
  EXPECT_EQ(force.y.title, "force x [N]");
  ASSERT_EQ(force.series.size(), 3u);
  EXPECT_EQ(force.series[0].label, "two standard deviations");
  EXPECT_NEAR(force.series[0].upper[1] - force.series[0].y[1], 4.0, 1e-12);
  EXPECT_EQ(force.series[1].label, "one");  // it may be computed or synthetic: the case names it
  EXPECT_NEAR(force.series[1].y[1], 2.0, 1e-12);
  ASSERT_EQ(force.series[2].x.size(), curve.n_rows());
  for (std::size_t i = 0; i < curve.n_rows(); ++i) {
    EXPECT_NEAR(force.series[2].x[i], 1e6 * curve.column("displacement_m")[i], 1e-9);
    EXPECT_NEAR(force.series[2].y[i], curve.column("force_x_N")[i], 1e-9);
  }
  const Chart energies = block<Chart>(page, "Energies");
  EXPECT_EQ(energies.series.size(), 3u);
  EXPECT_EQ(energies.y.title, "energy [µJ]");
  EXPECT_NEAR(energies.series[2].y.back(), 1e6 * curve.column("fracture_energy_J").back(), 1e-9);
  EXPECT_EQ(block<Chart>(page, "Staggered iterations").series[0].y, curve.column("staggered_iterations"));
  const Chart law = block<Chart>(page, "Cohesive law of \"crack\"");
  EXPECT_EQ(law.x.title, "normal separation [µm]");
  EXPECT_EQ(law.y.title, "normal traction [MPa]");
  EXPECT_GE(law.series[0].x.size(), curve.n_rows());
  EXPECT_EQ(row_of(block<Table>(page, "Materials"), "weak").substr(0, 1), "4");
  EXPECT_THAT(row_of(block<Table>(page, "Model and run"), "fracture"), HasSubstr("AT1"));
}

// A crack that runs along a beam, one face after the other: the mean traction over all faces stays far below the
// strength. The page draws the law that the case gives, and its faces are on it.
std::string peeled_beam() {
  return R"(kind = "fracture"
title = "a peeled beam"
[mesh]
generator = "box_hexes"
x = [{ length = "12 mm", cells = 48 }]
y = [{ length = "2 mm", cells = 4 }]
z = [{ length = "1 mm", cells = 1 }]
region = "arms"
[[mesh.slits]]
name = "slit"
lower = ["-1 mm", "1 mm", "-1 mm"]
upper = ["4 mm", "1 mm", "2 mm"]
[[mesh.patches]]
name = "upper"
lower = ["-1 mm", "1 mm", "-1 mm"]
upper = ["1e-6 mm", "3 mm", "2 mm"]
[[mesh.patches]]
name = "lower"
lower = ["-1 mm", "-1 mm", "-1 mm"]
upper = ["1e-6 mm", "1 mm", "2 mm"]
[materials.polymer]
regions = ["arms"]
young_modulus = "3 GPa"
poisson_ratio = 0.3
damageable = false
[fracture]
split = "none"
[[interface]]
name = "glue"
plane = { point = ["0 mm", "1 mm", "0 mm"], normal = [0, 1, 0] }
law = "linear"
strength = "20 MPa"
toughness = "200 J/m^2"
[[boundary]]
patch = "upper"
displacement = ["free", "0.5 mm", "free"]
[[boundary]]
patch = "lower"
displacement = ["free", "-0.5 mm", "free"]
[[boundary]]
patch = "xmax"
displacement = ["0 mm", "0 mm", "free"]
[[boundary]]
patches = ["zmin", "zmax"]
type = "plane"
[loading]
initial_increment = 0.025
maximum_increment = 0.025
[output]
curve = { patch = "upper", component = "y" }
frames_every = 0
)";
}

TEST(Report, DrawsTheGivenLawOfAnInterfaceAndTheStatesOfItsFaces) {
  const TemporaryCase directory(peeled_beam());
  const Outcome ran = run({"run", directory.path().string(), "--quiet"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Chart law = block<Chart>(page_of_fracture(directory), "Given law of \"glue\"");
  EXPECT_EQ(law.x.title, "equivalent separation [µm]");
  EXPECT_EQ(law.y.title, "equivalent traction [MPa]");
  ASSERT_EQ(law.series.size(), 2u);
  const Series &faces = law.series[0], &given = law.series[1];
  EXPECT_EQ(given.label, "given: linear, 20\u00a0MPa, 200 J/m²");
  EXPECT_NEAR(*std::ranges::max_element(given.y), 20.0, 1e-3);
  EXPECT_GT(given.x.back(), 20.0);  // 2 G/strength
  ASSERT_GT(faces.x.size(), 40u);
  std::size_t softened = 0;
  for (std::size_t i = 0; i < faces.x.size(); ++i) {  // on the line to 20 um, or on the way back to the origin
    EXPECT_LE(faces.y[i], 20.0 * std::max(0.0, 1.0 - faces.x[i] / 20.0) + 0.05) << faces.x[i];
    softened += faces.x[i] > 1.0 && faces.y[i] > 1.0 ? 1 : 0;
  }
  EXPECT_GT(softened, 5u);
  const std::string json = content_of(directory.results() / "cohesive.json");
  const std::size_t first = json.find("strength_Pa");
  EXPECT_EQ(std::stod(json.substr(first + 14)), 20e6) << json.substr(first, 40);
  EXPECT_THAT(json, HasSubstr("\"toughness_J_per_m2\": 200.0"));
  const std::size_t mean = json.find("largest_mean_traction_Pa");
  ASSERT_NE(mean, std::string::npos);
  EXPECT_LT(std::stod(json.substr(mean + 27)), 10e6);
}

TEST(Report, RefusesACurveWithoutRows) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const std::string curve = content_of(directory.results() / "force_displacement.csv");
  directory.write("results/force_displacement.csv", curve.substr(0, curve.find('\n') + 1));
  const Outcome outcome = run({"report", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("force_displacement.csv: it has no rows"));
}

/// The bar has two cells across and one through: its page shows the plane in which it has several.
TEST(Report, ShowsDamageInThePlaneOfAPlate) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Picture picture = block<Picture>(page_of_fracture(directory), "Damage, plane xy");
  EXPECT_THAT(picture.caption, HasSubstr("displacement 15\u00a0µm"));
  EXPECT_EQ(picture.x_title, "x [mm]");
  EXPECT_EQ(picture.cells.size(), 42u);
  double most = 0.0;
  for (const auto& cell : picture.cells) most = std::max(most, cell.value);
  EXPECT_GT(most, 0.9);
  EXPECT_EQ(picture.lines.size(), 4u);  // about the weak cells, in both rows
}

TEST(Report, ShowsDamageAlongABarAndInABody) {
  const std::string bar =
      replaced(bar_case(), "y = [{ length = \"1 mm\", cells = 2 }]", "y = [{ length = \"1 mm\", cells = 1 }]");
  const TemporaryCase slender(bar);
  ASSERT_EQ(run({"run", slender.path().string(), "--max-steps", "5"}).status, 0);
  const Chart profile = block<Chart>(page_of_fracture(slender), "Damage along the bar");
  EXPECT_EQ(profile.x.title, "x [mm]");
  ASSERT_EQ(profile.series[0].x.size(), 21u);
  EXPECT_NEAR(profile.series[0].x.front(), 10.0 / 21.0, 1e-6);
  EXPECT_TRUE(std::ranges::is_sorted(profile.series[0].x));
  const TemporaryCase thick(
      replaced(replaced(bar_case(), "z = [{ length = \"1 mm\", cells = 1 }]", "z = [{ length = \"1 mm\", cells = 2 }]"),
               "type = \"plane\"", "type = \"symmetry\""));
  ASSERT_EQ(run({"run", thick.path().string(), "--max-steps", "5"}).status, 0);
  const ReportPage page = page_of_fracture(thick);
  EXPECT_EQ(block<Picture>(page, "Damage, plane xz").cells.size(), 42u);
  EXPECT_EQ(block<Picture>(page, "Damage, plane yz").cells.size(), 4u);
  EXPECT_THAT(page.subtitle, HasSubstr("stopped by --max-steps"));
}

TEST(Report, TellsOfAMaterialPoint) {
  const TemporaryCase directory(tension_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const Outcome outcome = run({"report", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_files(directory.results());
  const CaseFile file = open_case(directory.path());
  const EndochronicCase point = read_endochronic_case(file.config.root(), file.directory);
  const ReportPage page = endochronic_page(point, "tension", case_hash(file, {}), directory.results());
  const CsvTable history = read_csv(directory.results() / "history.csv");
  const Chart loop = block<Chart>(page, "Stress against strain, xx");
  EXPECT_EQ(loop.x.title, "strain xx [%]");
  EXPECT_EQ(loop.y.title, "stress xx [MPa]");
  const Chart shear = block<Chart>(page, "Stress against strain, ");
  ASSERT_EQ(loop.series[0].x.size(), history.n_rows());
  for (std::size_t i = 0; i < history.n_rows(); ++i) {
    EXPECT_NEAR(loop.series[0].x[i], 100.0 * history.column("strain_xx")[i], 1e-12);
    EXPECT_NEAR(loop.series[0].y[i], 1e-6 * history.column("stress_xx_Pa")[i], 1e-9);
  }
  const Chart strains = block<Chart>(page, "Prescribed strains");
  ASSERT_EQ(strains.series.size(), 2u);
  EXPECT_EQ(strains.series[0].label, "xx");
  EXPECT_EQ(strains.series[1].label, "engineering shear xy");
  EXPECT_FALSE(std::isnan(strains.series[0].y[10]));
  EXPECT_TRUE(std::isnan(strains.series[0].y[15]));  // the second segment prescribes the shear alone
  EXPECT_NEAR(strains.series[1].y.back(), 200.0 * history.column("strain_xy").back(), 1e-12);
  EXPECT_EQ(block<Chart>(page, "Prescribed stresses").x.title, "time [s]");
  const Table parameters = block<Table>(page, "Parameters");
  EXPECT_EQ(row_of(parameters, "Young's modulus E"), "117\u00a0GPa");
  EXPECT_EQ(row_of(parameters, "kernel: C, alpha"), "30\u00a0GPa, 700");
  EXPECT_THAT(row_of(parameters, "hardening"), HasSubstr("saturating, f_inf = 2, b = 6"));
  EXPECT_EQ(block<Chart>(page, "Energies by volume").series.size(), 3u);
}

TEST(Report, RefusesResultsOfAnotherCase) {
  const TemporaryCase directory(tension_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  directory.write("case.toml", replaced(tension_case(), "alpha = 700", "alpha = 800"));
  const Outcome outcome = run({"report", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("another case"));
}

}  // namespace
}  // namespace pfdm::this_file
