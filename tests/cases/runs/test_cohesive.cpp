// pfdm cohesive from end to end, on a bar that breaks.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

std::string cohesive_case() { return bar_case() + crack_plane(); }

nlohmann::json json_in(const fs::path& file) { return nlohmann::json::parse(content_of(file)); }

TEST(Cohesive, ExtractsTheLawOfAPlane) {
  const TemporaryCase directory(cohesive_case());
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("cohesive law of \"crack\", 2 places"), std::string::npos) << outcome.out;
  const CsvTable law = read_csv(directory.results() / "cohesive_law.csv");
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  ASSERT_EQ(law.n_rows(), curve.n_rows());
  // Plane strain across z alone: the columns take the whole bar, whose other elongation is elastic.
  EXPECT_EQ(law.column("polar_angle_to_deg").back(), 180.0);
  const double plane_modulus = 30e9 / (1.0 - 0.2 * 0.2);
  const double constrained = 30e9 * 0.8 / (1.2 * 0.6);
  for (std::size_t i = 0; i < law.n_rows(); ++i) {
    const double traction = law.column("traction_Pa")[i];
    EXPECT_NEAR(traction, curve.column("force_x_N")[i] / 1e-6, 1e-4 * 30e9 * 1e-3);
    const double elastic = 0.02 * traction / constrained;
    EXPECT_GE(law.column("separation_m")[i], -1e-9);
    EXPECT_LE(law.column("separation_m")[i], curve.column("displacement_m")[i] - elastic + 1e-9);
  }
  EXPECT_GT(constrained, 0.9 * plane_modulus);
  const nlohmann::json surface = json_in(directory.results() / "cohesive.json")["surfaces"][0];
  EXPECT_EQ(surface["name"], "crack");
  EXPECT_NEAR(surface["area_m2"].get<double>(), 1e-6, 1e-12);
  EXPECT_GT(surface["laws"][0]["strength_Pa"].get<double>(), 1e6);
  EXPECT_GT(surface["laws"][0]["surface_energy_J_per_m2"].get<double>(), 60.0);
}

// The separation of a sound bar is zero but for rounding: it has no law.
TEST(Cohesive, HasNoLawWhereNothingCanBreak) {
  const TemporaryCase directory(
      replaced(cohesive_case(), "poisson_ratio = 0.2\n", "poisson_ratio = 0.2\ndamageable = false\n"));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("cohesive law of \"crack\", 2 places: never damaged (d at most 0.01), no law"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.out.find("int T ddelta"), std::string::npos) << outcome.out;
  const nlohmann::json surface = json_in(directory.results() / "cohesive.json")["surfaces"][0];
  EXPECT_EQ(surface["never_damaged_places"], 2);
  EXPECT_TRUE(surface["laws"].is_array() && surface["laws"].empty()) << surface;
  for (const char* file : {"cohesive_law.csv", "cohesive_law_places.csv"}) {
    const std::string law = content_of(directory.results() / file);
    EXPECT_TRUE(law.starts_with("# surface 0: crack; 2 of 2 places never damaged (d at most 0.01): no law\n")) << law;
    EXPECT_TRUE(law.ends_with(",step,load\n")) << law;
  }
  EXPECT_EQ(run({"report", directory.path().string()}).status, 0);
}

// In plane stress, held at two sides: its elastic elongation is that of E/(1 - nu^2), and the rest is the crack's,
// however it contracts across the plate.
TEST(Cohesive, ExtractsTheLawAroundAWholeBead) {
  // The shipped case with fewer layers and longer steps; as shipped it is within 2.5 %. The strength is 1.6 % below ft
  // on every mesh.
  const fs::path shipped = fs::path(PFDM_CASES_DIR) / "cohesive_sphere";
  std::string text = content_of(shipped / "case.toml");
  text = replaced(text, "cells = 97", "cells = 65");
  text = replaced(text, "initial_increment = 0.01", "initial_increment = 0.02");
  text = replaced(text, "maximum_increment = 0.01", "maximum_increment = 0.02");
  const TemporaryCase directory(text);
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet"}).status, 0);
  const CsvTable law = read_csv(directory.results() / "cohesive_law.csv");
  const CsvTable closed = read_csv(shipped / "data/closed_form.csv");
  const double ft = closed.column("traction_Pa").front(), final_separation = closed.column("separation_m").back();
  double worst = 0.0, strength = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < law.n_rows(); ++i) {
    const double w = law.column("separation_m")[i], T = law.column("traction_Pa")[i];
    strength = std::max(strength, T);
    if (w < 1e-4 * final_separation || w > final_separation) continue;
    worst = std::max(worst, std::abs(T / ft - (1.0 - w / final_separation)));
    ++compared;
  }
  std::printf("largest difference from the law %.2f %% of ft, strength %.2f %% above, %d points\n", 100.0 * worst,
              100.0 * (strength / ft - 1.0), compared);
  EXPECT_GT(compared, 60);
  EXPECT_LE(worst, 0.04);
  EXPECT_NEAR(strength, ft, 0.02 * ft);
}

TEST(Cohesive, ExtractsTheLawOfAPlaneInPlaneStress) {
  const TemporaryCase directory(replaced(cohesive_case(), "type = \"plane\"", "type = \"plane_stress\""));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const CsvTable law = read_csv(directory.results() / "cohesive_law.csv");
  const CsvTable curve = read_csv(directory.results() / "force_displacement.csv");
  ASSERT_EQ(law.n_rows(), curve.n_rows());
  for (std::size_t i = 0; i < law.n_rows(); ++i) {
    const double elastic = 0.02 * law.column("traction_Pa")[i] * (1.0 - 0.2 * 0.2) / 30e9;
    EXPECT_NEAR(law.column("separation_m")[i], curve.column("displacement_m")[i] - elastic, 1e-9);
  }
  EXPECT_GT(law.column("separation_m").back(), 10e-6);
}

TEST(Cohesive, TellsTheSameAfterARestart) {
  const TemporaryCase directory(cohesive_case());
  const std::string place = directory.path().string();
  const fs::path whole = directory.path() / "whole", broken = directory.path() / "broken";
  ASSERT_EQ(run({"run", place, "--output", whole.string()}).status, 0);
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--max-steps", "4"}).status, 0);
  // As if killed between the columns and the checkpoint.
  fs::copy_file(whole / "columns/crack/step_000009.csv", broken / "columns/crack/step_000009.csv");
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart", "--max-steps", "2"}).status, 0);
  EXPECT_FALSE(fs::exists(broken / "columns/crack/step_000009.csv"));
  ASSERT_EQ(run({"run", place, "--output", broken.string(), "--restart"}).status, 0);
  for (const char* file :
       {"cohesive_law.csv", "cohesive_law_places.csv", "debonding.csv", "cohesive.json", "columns/crack/places.csv",
        "columns/crack/step_000000.csv", "columns/crack/step_000010.csv"})
    EXPECT_EQ(content_of(broken / file), content_of(whole / file)) << file;
}

TEST(Cohesive, ForgetsSurfacesOfAnEarlierRun) {
  const TemporaryCase directory(cohesive_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  directory.write("case.toml", replaced(cohesive_case(), "\"crack\"", "\"middle\""));
  const Outcome outcome = run({"run", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json surfaces = json_in(directory.results() / "cohesive.json")["surfaces"];
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0]["name"], "middle");
  EXPECT_FALSE(fs::exists(directory.results() / "columns" / "crack"));
}

TEST(Cohesive, CanBeExtractedAgain) {
  const TemporaryCase directory(cohesive_case());
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  const std::string law = content_of(directory.results() / "cohesive_law.csv");
  fs::remove(directory.results() / "cohesive_law.csv");
  const Outcome outcome = run({"cohesive", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(content_of(directory.results() / "cohesive_law.csv"), law);
}

TEST(Cohesive, RefusesWhatIsNotThere) {
  const TemporaryCase directory(bar_case());
  const auto expect = [&](const std::string& command, const std::string& message) {
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect("cohesive", "there are no results; pfdm run makes them");
  expect("compare", "names no [experiment]");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  expect("cohesive", "the run recorded no columns: name the surfaces in [cohesive]");
  directory.write("case.toml", cohesive_case());
  expect("cohesive", "belongs to another case");
  ASSERT_EQ(run({"run", directory.path().string()}).status, 0);
  fs::remove(directory.results() / "columns/crack/step_000003.csv");
  expect("cohesive", "step 3 is missing; run the case again");
  directory.write("results/columns/crack/step_000003.csv", "nonsense\n");
  expect("cohesive", "step_000003.csv");
}

// ---- Export

TEST(CohesiveExport, WritesTheLawForOtherCodes) {
  const TemporaryCase directory(cohesive_case());
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place}).status, 0);
  const fs::path exports = directory.results() / "cohesive_law";
  EXPECT_FALSE(fs::exists(exports));
  const Outcome outcome = run({"cohesive", "--export", "abaqus,moose", place, "--export", "table", "--units", "mm-N-s",
                               "--energy", "80 J/m^2", "--shear-strength", "5 MPa"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("exported law of \"crack\""), std::string::npos) << outcome.out;
  for (const char* file : {"abaqus.inp", "moose.i", "table.csv"}) {
    EXPECT_NE(outcome.out.find((exports / file).string()), std::string::npos) << outcome.out;
    EXPECT_TRUE(fs::exists(exports / file)) << file;
  }
  EXPECT_FALSE(fs::exists(exports / "lsdyna.k"));
  EXPECT_NE(content_of(exports / "moose.i").find("\n    shear_strength = 5\n"), std::string::npos);
  const CsvTable table = read_csv(exports / "table.csv");
  const CsvTable law = read_csv(directory.results() / "cohesive_law.csv");
  EXPECT_NEAR(std::ranges::max(table.column("traction_MPa")), 1e-6 * std::ranges::max(law.column("traction_Pa")), 5e-3);
  // A new run has none of the old one's laws.
  ASSERT_EQ(run({"run", place}).status, 0);
  EXPECT_FALSE(fs::exists(exports));
}

TEST(CohesiveExport, RefusesWhatItDoesNotKnow) {
  const TemporaryCase directory(cohesive_case());
  const std::string place = directory.path().string();
  ASSERT_EQ(run({"run", place}).status, 0);
  const std::string law = content_of(directory.results() / "cohesive_law.csv");
  const auto expect = [&](std::vector<std::string> options, const std::string& message) {
    options.insert(options.begin(), {"cohesive", place});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect({"--export", "abacus"}, "no format \"abacus\" (available: abaqus, moose, lsdyna, optistruct, akantu, ");
  expect({"--export", "abaqus", "--units", "inch"}, "(available: SI, mm-N-s, mm-kN-ms, um-uN-s)");
  expect({"--export", "abaqus", "--surface", "x"}, "--surface: there is no surface \"x\" (available: crack)");
  expect({"--export", "abaqus", "--stiffness", "1e14"}, "--stiffness: \"1e14\" has no unit");
  expect({"--export", "abaqus", "--stiffness", "1e14 Pa"}, "--stiffness: \"1e14 Pa\" is a stress");
  expect({"--export", "abaqus", "--shear-energy", "-3 J/m^2"}, "--shear-energy: \"-3 J/m^2\" must be positive");
  expect({"--units", "SI"}, "--units requires --export");
  EXPECT_FALSE(fs::exists(directory.results() / "cohesive_law"));
  EXPECT_EQ(content_of(directory.results() / "cohesive_law.csv"), law);
}

class BadCohesive : public testing::TestWithParam<BadInput> {};

TEST_P(BadCohesive, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(cohesive_case(), GetParam().good, GetParam().bad));
  expect_refused(directory, GetParam());
}

const BadInput bad_cohesive[] = {
    {"plane_beside_the_body",
     "[\"10 mm\", \"0.5 mm\"",
     "[\"90 mm\", \"0.5 mm\"",
     {"case.toml:51: [cohesive.planes]", "the plane \"crack\" does not intersect the mesh"}},
    {"normal_of_zero", "[1, 0, 0]", "[0, 0, 0]", {"[cohesive.planes] normal", "must not be zero"}},
    {"no_half_width", "half_width = \"30 mm\"\n", "", {"\"half_width\" is missing"}},
    {"half_width_without_unit", "\"30 mm\"", "30", {"30 has no unit"}},
    {"name_that_is_no_folder", "name = \"crack\"", "name = \"../x\"", {"letters, digits, _ and - only"}},
    {"interface_that_is_no_band",
     "[cohesive]\n",
     "[cohesive]\ninterfaces = [\"weak\"]\n",
     {"interfaces[0]: \"weak\" is not a band between two regions"}},
    {"misspelt_key", "half_width", "half_with", {"did you mean \"half_width\"?"}},
};
INSTANTIATE_TEST_SUITE_P(Inputs, BadCohesive, testing::ValuesIn(bad_cohesive),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Cohesive, RefusesABandWithoutAnInnerSide) {
  const std::string band = replaced(bar_case(), "toughness = \"80 J/m^2\"\n",
                                    "toughness = \"80 J/m^2\"\nband = { width = \"0.8 mm\", between = [\"bar\", "
                                    "\"bar\"] }\n");
  EXPECT_EQ(run({"check", TemporaryCase(band).path().string()}).status, 0);
  const Outcome outcome =
      run({"check", TemporaryCase(band + "\n[cohesive]\ninterfaces = [\"weak\"]\n").path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("interfaces[0]: \"weak\" has \"bar\" on both sides"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
