// pfdm cohesive and pfdm compare from end to end, on a bar that breaks.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;

std::string cohesive_case() { return bar_case() + crack_plane(); }

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

// ---- Comparison

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
