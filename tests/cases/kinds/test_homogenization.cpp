// A case of kind "homogenize": results whose moduli are known in closed form, their numbers in other cases, and scatter
// by a sweep.

#include "postproc/fields/pvd.h"
#include "postproc/fields/stored_cells.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/kinds/laminate.h"
#include "tests/cases/page_data.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

nlohmann::json results_of(const TemporaryCase& directory) {
  return nlohmann::json::parse(content_of(directory.results() / "homogenized.json"));
}

std::string of_crystals(const std::string& more = "") {
  const std::string crystal = "elasticity = { C11 = \"168.4 GPa\", C12 = \"121.4 GPa\", C44 = \"75.4 GPa\" }\n" + more;
  return replaced(replaced(laminate(), "young_modulus = \"10 MPa\"\npoisson_ratio = 0.4\n", crystal),
                  "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\n", crystal);
}

// Turned by 45 degrees about z, C11 and C12 become (C11 + C12)/2 +- C44.
TEST(HomogenizationCase, TakesCrystalsAndTheirAxes) {
  const TemporaryCase along(of_crystals()), turned(of_crystals("axes = { first = [1, 1, 0], second = [-1, 1, 0] }\n"));
  for (const TemporaryCase* directory : {&along, &turned}) {
    const Outcome outcome = run({"run", directory->path().string(), "--threads", "1"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json results = results_of(*directory);
    const auto C = results["stiffness_Pa"].get<std::vector<std::vector<double>>>();
    const bool is_turned = directory == &turned;
    EXPECT_NEAR(C[0][0] / 1e9, is_turned ? 144.9 + 75.4 : 168.4, 1e-6);
    EXPECT_NEAR(C[0][1] / 1e9, is_turned ? 144.9 - 75.4 : 121.4, 1e-6);
    EXPECT_NEAR(C[2][2] / 1e9, 168.4, 1e-6);
    EXPECT_NEAR(C[5][5] / 1e9, is_turned ? 0.5 * (168.4 - 121.4) : 75.4, 1e-6);
    EXPECT_FALSE(results.contains("bounds"));
  }
  const TemporaryCase both(of_crystals("young_modulus = \"1 GPa\"\n"));
  EXPECT_THAT(run({"check", both.path().string()}).err, HasSubstr("the material has its elasticity already"));
}

// No cell of a box with crystals has a pressure.
TEST(HomogenizationCase, TellsOfRubberBesideCrystals) {
  const std::string crystal = "elasticity = { C11 = \"168.4 GPa\", C12 = \"121.4 GPa\", C44 = \"75.4 GPa\" }\n";
  const std::string beside = replaced(laminate(), "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\n", crystal);
  const TemporaryCase soft(beside), rubber(replaced(beside, "poisson_ratio = 0.4", "poisson_ratio = 0.499"));
  EXPECT_THAT(run({"check", soft.path().string()}).out, testing::Not(HasSubstr("incompressible")));
  const Outcome outcome = run({"run", rubber.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("\"soft\" is nearly incompressible (nu = 0.499) beside elasticity"));
}

double constrained_modulus(double E, double nu) { return E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)); }

TEST(HomogenizationCase, LaminateHasItsExactStiffnessDensityAndLoss) {
  const TemporaryCase directory(laminate());
  const Outcome outcome = run({"run", directory.path().string(), "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("closest isotropic: E = "));
  EXPECT_THAT(outcome.out, HasSubstr("energies against mean stresses"));
  const nlohmann::json json = results_of(directory);
  const double soft = constrained_modulus(10e6, 0.4), stiff = constrained_modulus(200e9, 0.3);
  const double across = 1.0 / (0.5 / soft + 0.5 / stiff);
  EXPECT_NEAR(json["stiffness_Pa"][2][2].get<double>() / across, 1.0, 1e-8);
  const double slip = 1.0 / (0.5 / (10e6 / 2.8) + 0.5 / (200e9 / 2.6));
  EXPECT_NEAR(json["stiffness_Pa"][3][3].get<double>() / slip, 1.0, 1e-8);
  EXPECT_NEAR(json["density_kg_per_m3"].get<double>(), 4400.0, 1e-9);
  for (const auto& phase : json["phases"]) EXPECT_NEAR(phase["volume_fraction"].get<double>(), 0.5, 1e-12);
  EXPECT_LE(json["errors"]["energy_difference"].get<double>(), 1e-8);
  // The compliance is the inverse.
  double product = 0.0;
  for (std::size_t k = 0; k < 6; ++k)
    product += json["stiffness_Pa"][2][k].get<double>() * json["compliance_per_Pa"][k][2].get<double>();
  EXPECT_NEAR(product, 1.0, 1e-9);
  // Reuss and Voigt bound K.
  const nlohmann::json bounds = json["bounds"]["reuss_voigt"];
  EXPECT_GE(json["isotropic"]["bulk_modulus_Pa"], bounds["bulk_modulus_lower_Pa"]);
  EXPECT_LE(json["isotropic"]["bulk_modulus_Pa"], bounds["bulk_modulus_upper_Pa"]);
  const CsvTable cases = read_csv(directory.results() / "homogenized.csv");
  EXPECT_EQ(cases.n_rows(), 6u);
  EXPECT_NEAR(cases.column("strain_xy")[5], std::sqrt(0.5), 1e-12);
}

// Across the layers the stress is the same in both, and the soft one takes the strain.
TEST(HomogenizationCase, HasAPageWithTheBodyInItsSixLoadCases) {
  const TemporaryCase directory(laminate());
  for (const char* command : {"run", "report"})
    ASSERT_EQ(run({command, directory.path().string(), "--threads", "1"}).status, 0);
  const nlohmann::json data = data_of_page(content_of(directory.results() / "report" / "index.html"));
  EXPECT_EQ(data["steps"].size(), 6u);
  EXPECT_EQ(data["body"]["frames"].size(), 6u);
  EXPECT_EQ(data["body"]["regions"], (std::vector<std::string>{"soft", "stiff"}));
  EXPECT_EQ(data["beside"][0].get<std::string>(), data["blocks"][0]["caption"].get<std::string>());
  const std::vector<Frame> frames = read_pvd(directory.results() / "fields.pvd");
  ASSERT_EQ(frames.size(), 6u);
  const StoredCells across(directory.results() / frames[2].file);
  const double stress = 0.01 * results_of(directory)["stiffness_Pa"][2][2].get<double>();
  for (const double value : across.values("stress", 2)) EXPECT_NEAR(value / stress, 1.0, 1e-6);
  const std::vector<double> material = across.values("material"), strain = across.values("strain", 2);
  const double soft = stress / constrained_modulus(10e6, 0.4), stiff = stress / constrained_modulus(200e9, 0.3);
  for (std::size_t c = 0; c < strain.size(); ++c)
    EXPECT_NEAR(strain[c] / (material[c] == 0.0 ? soft : stiff), 1.0, 1e-5);
  const std::vector<Vector> points = across.points(), moved = across.displacement();
  int n_pairs = 0;
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t q = 0; q < points.size(); ++q)
      if (points[p].head<2>() == points[q].head<2>() && points[p].z() == 1e-3 && points[q].z() == 0.0) {
        EXPECT_NEAR(moved[p].z() - moved[q].z(), 1e-5, 1e-9);  // 1 % of 1 mm
        ++n_pairs;
      }
  EXPECT_EQ(n_pairs, 12);
}

// All materials lose the same part: so does the composite.
TEST(HomogenizationCase, LossOfEqualMaterialsIsTheirs) {
  const TemporaryCase directory(
      replaced(laminate(), "density = \"7800 kg/m^3\"", "density = \"7800 kg/m^3\"\nloss_factor = 0.2"));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  for (const char* modulus : {"young_modulus", "bulk_modulus", "shear_modulus"})
    EXPECT_NEAR(results_of(directory)["loss_factors"][modulus].get<double>(), 0.2, 1e-7);
}

// Of uniform moduli each loss factor is the mean by volume: strain and stress are uniform.
TEST(HomogenizationCase, LossOfAUniformBodyIsTheMean) {
  std::string text = replaced(laminate(), "\"200 GPa\"", "\"10 MPa\"");
  const TemporaryCase directory(replaced(text, "poisson_ratio = 0.3", "poisson_ratio = 0.4"));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const nlohmann::json json = results_of(directory);
  EXPECT_NEAR(json["loss_factors"]["shear_modulus"].get<double>(), 0.1, 1e-9);
  EXPECT_NEAR(json["isotropic"]["young_modulus_Pa"].get<double>(), 10e6, 1e-2);
  EXPECT_NEAR(json["isotropic"]["poisson_ratio"].get<double>(), 0.4, 1e-9);
  EXPECT_LE(json["isotropic"]["anisotropy"].get<double>(), 1e-9);
}

TEST(HomogenizationCase, HasCheckMeshAndReport) {
  const TemporaryCase directory(laminate());
  const std::string path = directory.path().string();
  const Outcome checked = run({"check", path});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("six load cases, periodic"));
  EXPECT_EQ(run({"mesh", path}).status, 0);
  const Outcome early = run({"report", path});
  EXPECT_EQ(early.status, 2);
  EXPECT_THAT(early.err, HasSubstr("pfdm run makes them"));
  ASSERT_EQ(run({"run", path, "--quiet"}).status, 0);
  const Outcome reported = run({"report", path});
  EXPECT_EQ(reported.status, 0) << reported.err;
  EXPECT_TRUE(std::filesystem::exists(directory.results() / "report" / "report.pdf"));
}

std::string beads() {
  return R"(kind = "homogenize"
title = "a few beads"
[mesh]
generator = "packed_spheres"
size = ["1 mm", "1 mm", "1 mm"]
count = 4
volume_fraction = 0.1
gap = "30 um"
subdivisions = 1
edges_over_gap = 0
seed = 1
cells = "polyhedra"
[materials.glass]
regions = ["particle"]
young_modulus = "70 GPa"
poisson_ratio = 0.2
[materials.rubber]
regions = ["matrix"]
young_modulus = "1 MPa"
poisson_ratio = 0.3
[homogenization]
boundary = "uniform displacement"
[sweep]
method = "list"
[[sweep.parameters]]
key = "mesh.seed"
values = [1, 2, 3]
)";
}

TEST(HomogenizationCase, TellsOfCoarseMeshesByTheBounds) {
  const auto said = [](const std::string& text) {
    const TemporaryCase directory(text);
    const Outcome outcome = run({"run", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const auto tells = HasSubstr("% below Hashin and Shtrikman's lower bound");
  EXPECT_THAT(said(beads()), tells);
  EXPECT_THAT(said(replaced(beads(), "uniform displacement", "uniform traction")), testing::Not(tells));
  EXPECT_THAT(said(laminate()), testing::Not(tells));
}

TEST(HomogenizationCase, SweepOverSeedsHasMeanAndDeviation) {
  const TemporaryCase directory(beads());
  const Outcome outcome = run({"sweep", directory.path().string(), "--threads", "2"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable table = read_csv(directory.results() / "sweep.csv");
  const std::vector<double>& E = table.column("young_modulus_Pa");
  ASSERT_EQ(E.size(), 3u);
  const double mean = (E[0] + E[1] + E[2]) / 3.0;
  const double deviation =
      std::sqrt((std::pow(E[0] - mean, 2) + std::pow(E[1] - mean, 2) + std::pow(E[2] - mean, 2)) / 2.0);
  EXPECT_GT(deviation, 0.0);
  const std::string said =
      fmt::format("young modulus: mean {:.6g} MPa, standard deviation {:.3g} MPa", 1e-6 * mean, 1e-6 * deviation);
  EXPECT_THAT(outcome.out, HasSubstr(said));
  EXPECT_THAT(content_of(directory.results() / "sweep.csv"), HasSubstr(said));
}

// A bar of the composite's modulus.
TEST(HomogenizationCase, OtherCasesTakeItsNumbers) {
  const TemporaryCase directory(laminate());
  const std::string reference = R"({ from = "results/homogenized.json", key = "isotropic.young_modulus_Pa" })";
  for (const char* name : {"bar", "plain"}) std::filesystem::create_directory(directory.path() / name);
  directory.write("bar/case.toml", replaced(bar_case(), "\"30 GPa\"", replaced(reference, "results/", "../results/")));
  const std::string bar = (directory.path() / "bar").string();
  const Outcome early = run({"check", bar});
  EXPECT_EQ(early.status, 2);
  EXPECT_THAT(early.err, HasSubstr("case.toml:"));
  EXPECT_THAT(early.err, HasSubstr("there is no file ../results/homogenized.json; pfdm run "));
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const double E = results_of(directory)["isotropic"]["young_modulus_Pa"];
  EXPECT_EQ(run({"check", bar}).status, 0);
  directory.write("plain/case.toml", replaced(bar_case(), "\"30 GPa\"", fmt::format("\"{} Pa\"", E)));
  const auto stiffness = [&](const std::string& name) {
    EXPECT_EQ(run({"run", (directory.path() / name).string(), "--quiet", "--max-steps", "1"}).status, 0);
    return nlohmann::json::parse(content_of(directory.path() / name / "results/summary.json"));
  };
  const nlohmann::json by_reference = stiffness("bar"), by_number = stiffness("plain");
  EXPECT_EQ(by_reference["initial_stiffness_N_per_m"], by_number["initial_stiffness_N_per_m"]);
  // Other results make it another case.
  directory.write("results/homogenized.json", R"({ "isotropic": { "young_modulus_Pa": 1e9 } })");
  EXPECT_NE(stiffness("bar")["case_hash"], by_reference["case_hash"]);
  for (const auto& [wrong, said] :
       {std::pair("key = \"isotropic.young_modulus\"", "does not end in _Pa"),
        std::pair("key = \"isotropic.yung_modulus_Pa\"", "did you mean \"young_modulus_Pa\"?"),
        std::pair("key = \"isotropic\", unit = \"Pa\"", "is not a number"),
        std::pair("key = \"isotropic.young_modulus_Pa\", units = \"Pa\"", "\"units\" is not known beside \"from\""),
        std::pair("key = \"isotropic.young_modulus_Pa\", unit = \"mm\"", "expected a stress")}) {
    const std::string text = replaced(bar_case(), "\"30 GPa\"", replaced(reference, "results/", "../results/"));
    directory.write("bar/case.toml", replaced(text, "key = \"isotropic.young_modulus_Pa\"", wrong));
    const Outcome outcome = run({"check", bar});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(said));
  }
}

}  // namespace
}  // namespace pfdm::this_file
