// A case of kind "homogenize" with a path of mean strain or stress: its curve against springs in series, its files, a
// restart, other cases that read the curve.

#include "postproc/files/csv_table.h"
#include "tests/cases/page_data.h"
#include "tests/cases/parted_box.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

TEST(DebondingCase, CurveIsThatOfSpringsInSeries) {
  const TemporaryCase directory(parted_box());
  const Outcome outcome = run({"run", directory.path().string(), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = curve_of(directory);
  const std::vector<double>&load = curve.column("load"), &strain = curve.column("strain_zz"),
        &stress = curve.column("stress_zz_Pa"), &sideways = curve.column("strain_xx");
  ASSERT_EQ(load.size(), 21U);
  for (std::size_t i = 0; i < load.size(); ++i) {
    const double due = load[i] <= 1.0 ? 0.15 * load[i] : 0.15 - 0.1 * (load[i] - 1.0);
    const double back = due / 0.15;  // along the secant to the origin
    const double expected = load[i] <= 1.0 ? stress_at(due) : back * stress_at(0.15);
    EXPECT_NEAR(strain[i], due, 1e-12);
    EXPECT_NEAR(stress[i], expected, 1e-6 * ft);
    EXPECT_NEAR(sideways[i], -0.4 * expected / E, 1e-8);
  }
  EXPECT_EQ(curve.column("debonded_area_bond_m2").back(), 0.0);  // 150 of 200 um open
  const CsvTable forces = read_csv(directory.results() / "force_displacement.csv");
  EXPECT_NEAR(forces.column("displacement_m").back(), 0.05 * length, 1e-15);
  EXPECT_NEAR(forces.column("force_z_N").back(), stress.back() * 1e-6, 1e-12);
  const nlohmann::json summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_NEAR(summary["peak_stress_zz_Pa"], *std::ranges::max_element(stress), 1e-9);
  EXPECT_NEAR(summary["initial_modulus_zz_Pa"], stress[1] / strain[1], 1.0);
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "interfaces.pvd"));
  const Outcome reported = run({"report", directory.path().string()});
  EXPECT_EQ(reported.status, 0) << reported.err;
  const nlohmann::json page = data_of_page(content_of(directory.results() / "report" / "index.html"));
  EXPECT_THAT(page["steps"].back().get<std::string>(), HasSubstr("of 20: strain zz 0.05, stress "));
  const Outcome checked = run({"check", directory.path().string()});
  EXPECT_THAT(checked.out, HasSubstr("2 points of mean strain and stress, periodic"));
}

// The plane has dissipated 0.9025 of its toughness at an opening of some 180 um; steps of the strain are 2.5 %.
TEST(DebondingCase, TellsStrainAndStressOfTheFirstDebonding) {
  const TemporaryCase directory(
      replaced(parted_box(), "[{ strain_zz = \"15 %\" }, { strain_zz = 0.05 }]", "[{ strain_zz = 0.25 }]"));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_NEAR(summary["first_debonding_strain_zz"], 0.175, 1e-12);
  EXPECT_NEAR(summary["first_debonding_strain_zz_after"], 0.2, 1e-12);
  EXPECT_NEAR(summary["first_debonding_stress_zz_Pa"], stress_at(0.175), 1e-6 * ft);
  EXPECT_FALSE(summary.contains("first_debonding_force_N"));
  EXPECT_THAT(outcome.out,
              HasSubstr("First debonding of \"bond\" between strain_zz = 0.175 and 0.2, where the mean stress "
                        "zz goes from "));
}

// Without friction there is no stress at no strain; the plane resists compression by its initial stiffness.
TEST(DebondingCase, PathMayEndAtZeroAndPassIt) {
  const TemporaryCase directory(replaced(parted_box(), "strain_zz = 0.05", "strain_zz = -0.15 }, { strain_zz = 0"));
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable curve = curve_of(directory);
  const std::vector<double>&load = curve.column("load"), &strain = curve.column("strain_zz"),
        &stress = curve.column("stress_zz_Pa");
  int at_zero = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (std::abs(strain[i]) < 1e-12 && load[i] > 1.0) {
      EXPECT_NEAR(stress[i], 0.0, 1e-9 * ft);
      ++at_zero;
    }
    if (strain[i] < -0.01) {
      EXPECT_NEAR(stress[i], strain[i] / (1.0 / E + 1.0 / (K * length)), 1e-6 * E);
    }
  }
  EXPECT_EQ(at_zero, 2);
}

TEST(DebondingCase, UnderAStressThatIsPrescribedTheOthersAreFree) {
  const TemporaryCase directory(
      replaced(parted_box(), "{ strain_zz = \"15 %\" }, { strain_zz = 0.05 }", "{ stress_zz = \"0.05 MPa\" }"));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const CsvTable curve = curve_of(directory);
  EXPECT_NEAR(curve.column("stress_zz_Pa").back(), 0.05e6, 1e-3);
  EXPECT_NEAR(curve.column("strain_zz").back(), 0.05e6 * (1.0 / E + 1.0 / (K * length)), 1e-10);
  EXPECT_NEAR(curve.column("strain_yy").back(), -0.4 * 0.05e6 / E, 1e-10);
}

TEST(DebondingCase, GoesOnAfterAStopToTheSameCurve) {
  const TemporaryCase whole(parted_box()), stopped(parted_box());
  ASSERT_EQ(run({"run", whole.path().string(), "--quiet"}).status, 0);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--max-steps", "7"}).status, 0);
  EXPECT_EQ(curve_of(stopped).n_rows(), 8U);
  ASSERT_EQ(run({"run", stopped.path().string(), "--quiet", "--restart"}).status, 0);
  EXPECT_EQ(content_of(stopped.results() / "stress_strain.csv"), content_of(whole.results() / "stress_strain.csv"));
}

// The components of an inline table are those of the file's order, not of the alphabet; the first that is loaded
// counts.
TEST(DebondingCase, CurveIsOfTheFirstComponentThatIsLoaded) {
  const std::string point = "{ strain_zz = \"15 %\" }, { strain_zz = 0.05 }";
  for (const char* path :
       {"{ strain_zz = \"0.1 %\", strain_xx = 0, strain_yy = 0 }",
        "{ strain_xx = 0, strain_zz = 0.001, strain_yy = 0.0005 }", "{ }, { stress_zz = \"50 kPa\" }",
        "{ stress_zz = \"0 Pa\", stress_xx = \"0 Pa\" }, { stress_zz = \"50 kPa\", stress_xx = \"1 kPa\" }"}) {
    const TemporaryCase directory(replaced(parted_box(), point, path));
    const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
    EXPECT_TRUE(summary.contains("peak_stress_zz_Pa")) << path;
    EXPECT_GT(read_csv(directory.results() / "force_displacement.csv").column("force_z_N").back(), 0.0) << path;
    EXPECT_GT(read_csv(directory.results() / "force_displacement.csv").column("displacement_m").back(), 0.0) << path;
  }
}

// Its order says which component the curve is of: with another one a stopped run is not the same case.
TEST(DebondingCase, OrderWithinALineTellsPathsApart) {
  const std::string path = "{ strain_zz = \"15 %\" }, { strain_zz = 0.05 }";
  const TemporaryCase directory(replaced(parted_box(), path, "{ strain_zz = 0.01, strain_xx = 0.001 }"));
  const std::string name = directory.path().string();
  ASSERT_EQ(run({"run", name, "--quiet", "--max-steps", "2"}).status, 0);
  directory.write("case.toml", replaced(parted_box(), path, "{ strain_xx = 0.001, strain_zz = 0.01 }"));
  const Outcome other = run({"run", name, "--quiet", "--restart"});
  EXPECT_EQ(other.status, 2) << other.out;
  directory.write("case.toml", replaced(parted_box(), path, "{strain_zz=1e-2,strain_xx = 1e-3}"));
  const Outcome same = run({"run", name, "--quiet", "--restart"});
  EXPECT_EQ(same.status, 0) << same.err;
}

TEST(DebondingCase, AndTheLinearOneReplaceEachOther) {
  const std::string path =
      "path = [{ strain_zz = \"15 %\" }, { strain_zz = 0.05 }]\n[loading]\ninitial_increment = 0.1\n"
      "maximum_increment = 0.1\n[solver]\nequilibrium_tolerance = 1e-10\n";
  std::string linear = replaced(parted_box(), path, "");
  linear.erase(linear.find("[[interface]]"), linear.find("[homogenization]") - linear.find("[[interface]]"));
  const TemporaryCase directory(linear);
  const std::string name = directory.path().string();
  const auto exists = [&](const char* file) { return std::filesystem::exists(directory.results() / file); };
  ASSERT_EQ(run({"run", name, "--quiet"}).status, 0);
  EXPECT_TRUE(exists("homogenized.json") && exists("homogenized.csv"));
  directory.write("case.toml", parted_box());
  ASSERT_EQ(run({"run", name, "--quiet", "--max-steps", "7"}).status, 0);
  EXPECT_FALSE(exists("homogenized.json") || exists("homogenized.csv"));
  EXPECT_TRUE(exists("checkpoint.bin") && exists("stress_strain.csv"));
  std::filesystem::remove(directory.results() / "summary.json");  // as of a run that was killed
  directory.write("case.toml", linear);
  ASSERT_EQ(run({"run", name, "--quiet"}).status, 0);
  for (const char* file : {"checkpoint.bin", "stress_strain.csv", "force_displacement.csv", "fields/step_000000.vtu",
                           "interfaces.pvd", "interfaces/step_000000.vtu"})
    EXPECT_FALSE(exists(file)) << file;
  EXPECT_THAT(content_of(directory.results() / "fields.pvd"), testing::Not(testing::HasSubstr("step_")));
  EXPECT_TRUE(exists("homogenized.json") && exists("mesh.vtu"));
}

// An interface that ends at a side which is in one piece cannot open there; periodic sides let it.
TEST(DebondingCase, SaysWhereSidesHoldAnInterface) {
  const std::string half = replaced(parted_box(), "law = \"linear\"", "law = \"linear\"\nwhere = \"x < 0.0005\"");
  const auto run_of = [](const std::string& text) {
    const TemporaryCase directory(replaced(text, "[loading]\n", "[loading]\nend = 0.1\n"));
    return run({"run", directory.path().string()});
  };
  const Outcome held = run_of(replaced(half, "boundary = \"periodic\"", "boundary = \"uniform displacement\""));
  EXPECT_EQ(held.status, 0) << held.err;
  EXPECT_THAT(held.out + held.err, HasSubstr("interface \"bond\" ends at a side of the box"));
  const Outcome periodic = run_of(half);
  EXPECT_EQ(periodic.status, 0) << periodic.err;
  EXPECT_THAT(periodic.out + periodic.err, testing::Not(HasSubstr("ends at a side")));
}

// The two parts of the box are joined by its periodic sides.
TEST(DebondingCase, ACrackMayGoRightAcrossAPeriodicBox) {
  std::string cracked = parted_box();
  cracked.erase(cracked.find("[[interface]]"), cracked.find("[homogenization]") - cracked.find("[[interface]]"));
  cracked = replaced(cracked, "poisson_ratio = 0.4\n", R"(poisson_ratio = 0.4
toughness = "10 J/m^2"
[fracture]
model = "AT1"
split = "none"
length = "1 mm"
[[initial.cracks]]
points = [["0 mm", "0 mm", "0.375 mm"], ["1 mm", "0 mm", "0.375 mm"], ["1 mm", "1 mm", "0.375 mm"], ["0 mm", "1 mm", "0.375 mm"]]
)");
  const TemporaryCase directory(cracked);
  const Outcome checked = run({"check", directory.path().string()});
  EXPECT_EQ(checked.status, 0) << checked.err;
}

// As an experiment that an endochronic law is fitted to: the columns are found, the load parameter is the time.
TEST(DebondingCase, AnEndochronicFitReadsTheCurve) {
  const TemporaryCase directory(replaced(parted_box(), ", { strain_zz = 0.05 }", ""));
  std::filesystem::create_directory(directory.path() / "law");
  directory.write("law/case.toml", R"(kind = "endochronic"
title = "law of a curve"
[material]
young_modulus = "45 MPa"
poisson_ratio = 0.4
kernel = [{ C = "10 MPa", alpha = 100 }]
[[loading.segments]]
duration = "1 s"
increments = 5
control = { strain_zz = 0.01 }
[fit]
estimate = ["kernel"]
[[fit.experiments]]
name = "box"
csv = "../results/stress_strain.csv"
time = "load"
time_unit = "s"
strain = { strain_zz = { column = "strain_zz" } }
stress = { stress_zz = { column = "stress_zz_Pa", unit = "Pa", noise = "1 kPa" } }
)");
  const std::string law = (directory.path() / "law").string();
  const Outcome early = run({"check", law});
  EXPECT_EQ(early.status, 2);
  EXPECT_THAT(early.err, HasSubstr("stress_strain.csv"));
  EXPECT_THAT(early.err, HasSubstr("pfdm run "));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const Outcome fitted = run({"fit", law, "--quiet"});
  EXPECT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "law" / "results" / "fit.json"));
}

}  // namespace
}  // namespace pfdm::this_file
