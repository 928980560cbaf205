// pfdm init --specimen, and what it makes: cases that check, records that are recognised, data reduction.

#include "cases/program/specimens/specimen_file.h"
#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path shipped = PFDM_CASES_DIR;

Outcome made(const TemporaryCase& directory, const std::string& specimen, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"init", (directory.path() / "new").string(), "--specimen", specimen};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

void expect_refused(const std::string& specimen, const std::vector<std::string>& more, const std::string& message) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = made(directory, specimen, more);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr(message));
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_FALSE(fs::exists(directory.path() / "new"));
}

struct Beam {
  double toughness, width;
  std::function<double(double)> compliance, slope;  ///< C(a) [m/N], dC/da
};

/// A synthetic record in mm and N: a straight rise, then a crack that grows at one toughness.
std::string record_of(const Beam& beam, double a0, double a_end, const std::string& head, bool with_lengths) {
  std::string text = "# synthetic: a beam in closed form\n" + head + "\n";
  const auto add = [&](double P, double a, bool grows) {
    text += fmt::format("{};{}{}\n", 1e3 * P * beam.compliance(a), P,
                        with_lengths ? (grows ? fmt::format(";{}", 1e3 * a) : std::string(";")) : "");
  };
  const auto force = [&](double a) { return std::sqrt(2.0 * beam.width * beam.toughness / beam.slope(a)); };
  for (int i = 0; i < 40; ++i) add(force(a0) * i / 40.0, a0, false);
  for (int i = 0; i <= 40; ++i) add(force(a0 + (a_end - a0) * i / 40.0), a0 + (a_end - a0) * i / 40.0, true);
  return text;
}

/// E = 130 GPa, b = 25 mm, h = 1.5 mm, the crack acts 2.745 mm longer.
Beam opened_beam() {
  const double factor = 8.0 / (130e9 * 25e-3 * std::pow(1.5e-3, 3)), delta = 2.745e-3;
  return {300.0, 25e-3, [=](double a) { return factor * std::pow(a + delta, 3); },
          [=](double a) { return 3.0 * factor * std::pow(a + delta, 2); }};
}

nlohmann::json reduction_of(const TemporaryCase& directory) {
  return nlohmann::json::parse(content_of(directory.path() / "new/results/reduction.json"));
}

double propagation(const nlohmann::json& reduction, const std::string& method) {
  for (const auto& found : reduction["tests"][0]["methods"])
    if (found["name"] == method) return found["propagation"]["G_J_per_m2"];
  return NAN;
}

TEST(Specimens, CheckWithoutWarnings) {
  for (const std::string& specimen : specimen_names(shipped)) {
    const TemporaryCase directory(bar_case());
    const Outcome outcome = made(directory, specimen);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("run " + (directory.path() / "new").string()));
    const Outcome checked = run({"check", (directory.path() / "new").string()});
    EXPECT_EQ(checked.status, 0) << specimen;
    EXPECT_EQ(checked.err, "") << specimen;
    EXPECT_THAT(checked.out, HasSubstr("the input is valid"));
    EXPECT_THAT(content_of(directory.path() / "new/README.md"), HasSubstr("| specimen |"));
  }
}

TEST(Specimens, AreListedWithTheirDefaults) {
  const Outcome all = run({"init", "--specimen"});
  EXPECT_EQ(all.status, 0);
  for (const std::string& specimen : specimen_names(shipped)) EXPECT_THAT(all.out, HasSubstr(specimen));
  EXPECT_THAT(all.out, HasSubstr("crack_length         50 mm"));
  EXPECT_THAT(run({"init", "--specimen", "end_notched_flexure"}).out, HasSubstr("half_span            50 mm"));
}

TEST(Specimens, RefuseWhatIsWrong) {
  const std::string dcb = "double_cantilever_beam", enf = "end_notched_flexure";
  expect_refused("double_cantilever", {}, "there is no specimen \"double_cantilever\"; did you mean \"double_cant");
  expect_refused(dcb, {"--set", "widht=20 mm"},
                 "--set widht: double_cantilever_beam has no such value; did you mean \"width\"?");
  expect_refused(dcb, {"--set", "width=20"}, "--set width: \"20\" has no unit");
  expect_refused(dcb, {"--set", "width=20 MPa"}, "--set width:");
  expect_refused(dcb, {"--set", "width=-20 mm"}, "--set width: \"-20 mm\" must be positive");
  expect_refused(dcb, {"--set", "width"}, "NAME=VALUE is required");
  expect_refused(dcb, {"--set", "poisson_ratio=0.7"}, "must be above -0.5 and below 0.49");
  expect_refused(dcb, {"--set", "crack_length=4 mm"}, "is too short for arms of \"1.5 mm\"");
  expect_refused(dcb, {"--set", "length=60 mm"}, "length \"60 mm\" is too short: the crack grows up to");
  expect_refused(dcb, {"--set", "strength=3 GPa"}, "a smaller strength");
  expect_refused(enf, {"--set", "crack_length=49 mm"}, "comes too near to the nose");
  expect_refused(enf, {"--set", "shear_toughness=100 J/m^2"}, "must be at least toughness");
  const std::string compact = "compact_tension";
  expect_refused(compact, {"--set", "crack_length=35 mm"}, "must be between 0.3 and 0.75 of depth");
  expect_refused(compact, {"--set", "strength=5 MPa"}, "is not small against the ligament");
  expect_refused(compact, {"--set", "strength=1 GPa"}, "a smaller strength");
  const std::string mixed = "mixed_mode_bending";
  expect_refused(mixed, {"--set", "lever=15 mm"}, "is too short: at a third of half_span");
  expect_refused(mixed, {"--set", "lever=50.1 mm"}, "make them equal");
  expect_refused(mixed, {"--set", "crack_length=48 mm"}, "comes too near to the middle");
  const std::string lap = "lap_joint";
  expect_refused(lap, {"--set", "shear_toughness=100 J/m^2"}, "must be at least toughness");
  expect_refused(lap, {"--set", "overlap=2 mm"}, "two times the sheet's thickness");
  expect_refused(lap, {"--set", "adhesive_shear_modulus=100 kPa"}, "breaks before it has stored its strength");
  const std::string disc = "poker_chip";
  expect_refused(disc, {"--set", "diameter=4 mm"}, "must be 3 to 60 times the thickness");
  expect_refused(disc, {"--set", "bulk_modulus=10 GPa"}, "0.47 to 0.4999 are rubbers");
  expect_refused(disc, {"--set", "strength=200 MPa"}, "would open at once");
  expect_refused(disc, {"--set", "diameter=6 mm", "--set", "strength=3 MPa"}, "\"3 MPa\" is not reached");
  expect_refused(dcb, {"--data", "no_such_file.csv"}, "no_such_file.csv");
  expect_refused(dcb, {"--set", "force_column=F"}, "there is no record whose column it is");
}

TEST(Specimens, BeginOnlyNewDirectories) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"init", directory.path().string(), "--specimen", "double_cantilever_beam"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the directory is not empty"));
  EXPECT_EQ(run({"init", "x", "--data", "y.csv"}).status, 2);
  EXPECT_EQ(run({"init", "x", "--like", "bar_at1", "--specimen", "double_cantilever_beam"}).status, 2);
}

TEST(Specimens, TakeWhatTheRecordSays) {
  const TemporaryCase directory(bar_case());
  directory.write("test.csv", record_of(opened_beam(), 50e-3, 75e-3, "Opening [mm];Load [N];Crack length [mm]", true));
  const Outcome outcome =
      made(directory, "double_cantilever_beam", {"--data", (directory.path() / "test.csv").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("displacement: column \"Opening [mm]\" in mm"));
  EXPECT_THAT(outcome.out, HasSubstr("crack_length: column \"Crack length [mm]\" in mm"));
  const std::string text = content_of(directory.path() / "new/case.toml");
  EXPECT_THAT(text, HasSubstr("young_modulus = \"130 GPa\""));
  EXPECT_THAT(text, Not(HasSubstr("toe = ")));
  EXPECT_EQ(content_of(directory.path() / "new/data/test.csv"), content_of(directory.path() / "test.csv"));
  const Outcome checked = run({"check", (directory.path() / "new").string()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_EQ(checked.err, "");
  EXPECT_THAT(checked.out, HasSubstr("fit of interface[0].toughness"));

  const Outcome reduced = run({"reduce", (directory.path() / "new").string()});
  ASSERT_EQ(reduced.status, 0) << reduced.err;
  EXPECT_THAT(reduced.out, HasSubstr("modified_beam_theory: NL"));
  const nlohmann::json reduction = reduction_of(directory);
  // F of the standard, up to 2.5 % here, is in the first; what it leaves out is less than 0.1 % of the last.
  EXPECT_NEAR(propagation(reduction, "modified_beam_theory"), 300.0, 8.0);
  EXPECT_NEAR(propagation(reduction, "equivalent_crack"), 300.0, 1.5);
  EXPECT_THAT(content_of(directory.path() / "new/results/reduction.csv"), HasSubstr("G_J_per_m2"));
}

TEST(Specimens, TurnShiftAndNameRecords) {
  const TemporaryCase directory(bar_case());
  std::string text = "u;F\n0;0\n0,2;0\n";  // slack of 0.5 mm, decimal commas, forces negative
  for (int i = 1; i <= 40; ++i) {
    std::string row = fmt::format("-{:.4f};-{:.4f}\n", 0.5 + 0.1 * i, 1.0 * i);
    std::ranges::replace(row, '.', ',');
    text += row;
  }
  directory.write("raw.csv", replaced(text, "0,2;0", "-0,2;0"));
  const std::string file = (directory.path() / "raw.csv").string();
  expect_refused("double_cantilever_beam", {"--data", file},
                 "no column of it is known for a displacement; --set displacement_column=NAME");
  const Outcome outcome = made(directory, "double_cantilever_beam",
                               {"--data", file, "--set", "displacement_column=u", "--set", "force_column=F"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the file does not say its unit: mm taken"));
  const std::string made_text = content_of(directory.path() / "new/case.toml");
  EXPECT_THAT(made_text, HasSubstr("displacement = { column = \"u\", unit = \"mm\", factor = -1 }"));
  EXPECT_THAT(made_text, HasSubstr("toe = [\"4 N\", \"20 N\"]"));
  EXPECT_EQ(run({"check", (directory.path() / "new").string()}).err, "");
}

TEST(Specimens, TakeThePartOfTheForceThatIsComputed) {
  const TemporaryCase directory(bar_case());
  std::string text = "displacement [mm],load [N]\n";
  for (int i = 0; i <= 40; ++i) text += fmt::format("{},{}\n", 0.02 * i, 400.0 * i / (10 + i));
  directory.write("disc.csv", text);
  const Outcome outcome = made(directory, "poker_chip", {"--data", (directory.path() / "disc.csv").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("0.01389 of the specimen is computed"));
  EXPECT_THAT(content_of(directory.path() / "new/case.toml"),
              HasSubstr("force = { column = \"load\", unit = \"N\", factor = 0.0138888889 }"));
  EXPECT_EQ(run({"check", (directory.path() / "new").string()}).err, "");
}

/// Stiffness [N/m] of the first step, with `more` in case.toml.
double stiffness_of(const std::string& specimen, const std::string& force = "force_y_N", const std::string& more = "") {
  const TemporaryCase directory(bar_case());
  EXPECT_EQ(made(directory, specimen).status, 0);
  directory.write("new/case.toml", content_of(directory.path() / "new/case.toml") + more);
  EXPECT_EQ(run({"run", (directory.path() / "new").string(), "--max-steps", "1", "--quiet"}).status, 0);
  const CsvTable curve = read_csv(directory.path() / "new/results/force_displacement.csv");
  return curve.column(force)[1] / curve.column("displacement_m")[1];
}

// E = 130 GPa, b = 25 mm, h = 1.5 mm, chi = 1.830 by hand (E33 = 9 GPa, G13 = 5 GPa).
TEST(Specimens, AreAsStiffAsBeams) {
  const double E = 130e9, b = 25e-3, h = 1.5e-3, chi = 1.830, L = 50e-3;
  const double opened = E * b * h * h * h / (8.0 * std::pow(50e-3 + chi * h, 3));
  EXPECT_NEAR(stiffness_of("double_cantilever_beam") / opened, 1.0, 0.01);
  const double bent = (2.0 * L * L * L + 3.0 * std::pow(30e-3 + 0.42 * chi * h, 3)) / (8.0 * E * b * h * h * h) +
                      3.0 * L / (10.0 * b * h * 5e9);
  EXPECT_NEAR(stiffness_of("end_notched_flexure") * bent, 1.0, 0.01);
}

// ASTM D6671 at c = 42 mm: its roots' rotation is that of the model, up to the mix of both modes.
TEST(Specimens, BendAsTheLeverOfTheStandardDoes) {
  const double E = 130e9, b = 25e-3, h = 1.5e-3, chi = 1.830, L = 50e-3, c = 42e-3, a = 30e-3;
  const double opened = 8.0 * std::pow(a + chi * h, 3) * std::pow(3.0 * c - L, 2);
  const double bent = (6.0 * std::pow(a + 0.42 * chi * h, 3) + 4.0 * L * L * L) * std::pow(c + L, 2);
  const double compliance = (opened + bent) / (16.0 * L * L * b * h * h * h * E);
  EXPECT_NEAR(stiffness_of("mixed_mode_bending") * compliance, 1.0, 0.015);
}

// E' B C = 36.99 at a/W = 0.5 (Saxena, Hudak 1978), E = 3 GPa, nu = 0.35, B = 20 mm.
TEST(Specimens, AreAsStiffAsCompactSpecimens) {
  EXPECT_NEAR(stiffness_of("compact_tension") / (3e9 / (1.0 - 0.35 * 0.35) * 20e-3 / 36.99), 1.0, 0.01);
}

// Shear lag (Volkersen 1938) where the sheets cannot bend: 63.5 mm free at each end, E' = 70 GPa/(1 - 0.33^2), t = 1.62
// mm, K = 0.9 GPa/0.2 mm.
TEST(Specimens, PassShearOverAsVolkersenSays) {
  const double E = 70e9 / (1.0 - 0.33 * 0.33), t = 1.62e-3, l = 12.7e-3, b = 25.4e-3;
  const double w = std::sqrt(2.0 * (0.9e9 / 0.2e-3) / (E * t));
  const double compliance = (2.0 * 63.5e-3 + 0.5 * l + 1.0 / (w * std::tanh(0.5 * w * l))) / (E * t * b);
  const std::string flat =
      "\n[[boundary]]\npatches = [\"ymin\", \"ymax\"]\ndisplacement = [\"free\", \"0 mm\", \"free\"]\n";
  EXPECT_NEAR(stiffness_of("lap_joint", "force_x_N", flat) * compliance, 1.0, 0.005);
}

// Thick sheets bend at the overlap, and give 1.3 times what they do in line.
TEST(Specimens, OfThickSheetsFailWithinTheRun) {
  const TemporaryCase directory(bar_case());
  ASSERT_EQ(made(directory, "lap_joint", {"--set", "thickness=3.2 mm"}).status, 0);
  ASSERT_EQ(run({"run", (directory.path() / "new").string(), "--quiet"}).status, 0);
  const std::vector<double> force =
      read_csv(directory.path() / "new/results/force_displacement.csv").column("force_x_N");
  EXPECT_GT(std::ranges::max(force), 10e3);  // 11.29 kN of shear strength times overlap and width
  EXPECT_LT(force.back(), 0.5 * std::ranges::max(force));
}

// Apparent modulus K I2(s)/I0(s) + E of a thin layer, s = (3 mu/K)^(1/2) R/H, without the free rim: 25.51 MPa by hand,
// of which elements have 24.86.
TEST(Specimens, AreAsStiffAsBondedDiscs) {
  const double area = 3.14159265 * 1e-4 / 72.0;
  EXPECT_NEAR(stiffness_of("poker_chip", "force_z_N") * 1.9e-3 / area, 24.86e6, 0.01 * 24.86e6);
}

TEST(Reduce, NeedsASpecimen) {
  const TemporaryCase directory(bar_case());
  const Outcome outcome = run({"reduce", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("[experiment.reduction]"));
}

TEST(Reduce, RefusesWrongDimensions) {
  const TemporaryCase directory(bar_case() + measured_specimen());
  fs::create_directories(directory.path() / "data");
  directory.write("data/one.csv", "u,f\n0,0\n5,1\n10,2\n");
  const std::string bar = content_of(directory.path() / "case.toml");
  const auto expect = [&](const std::string& table, const std::string& message) {
    directory.write("case.toml", bar + "\n[experiment.reduction]\n" + table);
    const Outcome outcome = run({"reduce", directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << table;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  const std::string flexure = "specimen = \"end_notched_flexure\"\nwidth = \"25 mm\"\nthickness = \"3 mm\"\n";
  expect("specimen = \"beam\"\n", "double_cantilever_beam");
  expect(flexure + "half_span = \"50 mm\"\n", "\"crack_length\"");
  expect(flexure + "half_span = \"50 mm\"\ncrack_length = \"50 mm\"\n", "must be shorter than half_span");
  expect(flexure + "half_span = \"50 mm\"\ncrack_length = \"30 mm\"\nlever = \"50 mm\"\n", "lever");
  expect(flexure + "half_span = \"50 mm\"\ncrack_length = \"30 mm\"\ncalibration_lengths = [\"20 mm\", \"30 mm\"]\n",
         "each length has one");
  expect(flexure + "half_span = \"50 mm\"\ncrack_length = \"30 mm\"\n", "initial compliance needs three");
}

}  // namespace
}  // namespace pfdm::this_file
