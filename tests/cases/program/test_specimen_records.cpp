// Records of testing machines that pfdm init --specimen takes.

#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string dcb = "double_cantilever_beam";

/// Rows 0 to 40 of n columns: 1 N and 0.1 mm more in each, after `slack` [mm] at no force.
std::string straight_rows(const std::string& head, int n, double slack = 0.0) {
  std::string text = head + "\n";
  for (int i = 0; i <= 40; ++i) {
    text += fmt::format("{:.4f};{:.4f}", slack + 0.1 * i, 1.0 * i);
    for (int k = 2; k < n; ++k) text += fmt::format(";{:.4f}", 50.0 + 0.01 * i);
    text += "\n";
  }
  return text;
}

struct Made {
  Outcome outcome;
  std::string text;       ///< case.toml, if there is one
  std::string warning{};  ///< of its check
};

/// The case of records with these contents.
Made made(const std::vector<std::string>& records, const std::string& specimen = dcb,
          const std::vector<std::string>& set = {}) {
  const TemporaryCase directory(bar_case());
  std::vector<std::string> words{"init", (directory.path() / "new").string(), "--specimen", specimen};
  for (const std::string& value : set) words.insert(words.end(), {"--set", value});
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::string name = fmt::format("record{}.csv", i + 1);
    directory.write(name, records[i]);
    words.insert(words.end(), {"--data", (directory.path() / name).string()});
  }
  const Outcome outcome = run(words);
  if (outcome.status != 0) return {outcome, content_of(directory.path() / "new/case.toml")};
  return {outcome, content_of(directory.path() / "new/case.toml"),
          run({"check", (directory.path() / "new").string()}).err};
}

void expect_refused(const std::string& head, int n, const std::string& message) {
  const Made result = made({straight_rows(head, n)});
  EXPECT_EQ(result.outcome.status, 2) << head;
  EXPECT_THAT(result.outcome.err, HasSubstr(message));
  EXPECT_EQ(result.text, "");
}

/// [mm], [N] of the columns that are taken; "" where none is.
void expect_columns(const std::string& head, int n, const std::string& displacement, const std::string& force,
                    const std::string& crack_length) {
  const Made result = made({straight_rows(head, n)});
  ASSERT_EQ(result.outcome.status, 0) << head << ": " << result.outcome.err;
  EXPECT_THAT(result.text, HasSubstr(fmt::format("displacement = {{ column = \"{}\"", displacement))) << head;
  EXPECT_THAT(result.text, HasSubstr(fmt::format("\nforce = {{ column = \"{}\"", force))) << head;
  if (crack_length.empty())
    EXPECT_THAT(result.text, Not(HasSubstr("\ncrack_length = {"))) << head;
  else
    EXPECT_THAT(result.text, HasSubstr(fmt::format("\ncrack_length = {{ column = \"{}\"", crack_length))) << head;
}

// A laminate's moduli and the dimensions of the standard are said where a record of something else would take them.
TEST(MachineRecords, TellWhatIsTakenOfTheSpecimen) {
  const std::string record = straight_rows("Opening [mm];Load [N]", 2);
  const Made result = made({record}, dcb, {"width=20 mm"});
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  EXPECT_THAT(result.outcome.out, HasSubstr("not given, so taken as usual: thickness 3 mm, crack_length 50 mm, length "
                                            "125 mm, transverse_modulus 9 GPa, shear_modulus 5 GPa"));
  EXPECT_THAT(result.outcome.out, Not(HasSubstr("usual: width")));
  const Made one_arm = made({record}, dcb, {"thickness=1.5 mm"});
  ASSERT_EQ(one_arm.outcome.status, 0) << one_arm.outcome.err;
  EXPECT_THAT(one_arm.outcome.out, HasSubstr("warning: young_modulus"));
  EXPECT_THAT(one_arm.outcome.out, HasSubstr("thickness is that of both arms together, \"1.5 mm\""));
  EXPECT_THAT(result.outcome.out, Not(HasSubstr("warning")));
}

TEST(MachineRecords, AreReadByWholeWordsAndUnits) {
  expect_columns("Crack opening displacement [mm];Load [N]", 2, "Crack opening displacement", "Load", "");
  expect_columns("COD [mm];Load [N];Crack extension [mm]", 3, "COD", "Load", "");
  expect_columns("Opening [mm];Load [N];Crack growth rate;Crack length [mm]", 4, "Opening", "Load", "Crack length");
  expect_columns("Extension;Force;Force rate;Load time;a (mm)", 5, "Extension", "Force", "a");
  expect_columns("Stroke [mm];Load [N];Load-line displacement [V]", 3, "Stroke", "Load", "");
  expect_columns("displacement_mm;load_N;crack_length_mm", 3, "displacement_mm", "load_N", "crack_length_mm");
  expect_columns("Weg [mm];Kraft [N];Schwingweg [s]", 3, "Weg", "Kraft", "");
  expect_columns("Stroke [mm];Force [lbf]", 2, "Stroke", "Force", "");
}

TEST(MachineRecords, OfUnknownUnitsAreRefused) {
  expect_refused("Opening [mm];Load [lbs]", 2, "the unit \"lbs\" of column \"Load [lbs]\" is not known");
  expect_refused("Opening [mm];Load [lb]", 2, "\"Load [lb]\" is no force");
  expect_refused("Unloading [mm];Load [N]", 2, "no column of it is known for a displacement");
}

TEST(MachineRecords, HaveEachItsOwnToe) {
  const Made result = made({straight_rows("Opening [mm];Load [N]", 2), straight_rows("Opening [mm];Load [N]", 2, 0.5)});
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  const std::string &text = result.text, toe = "toe = [\"4 N\", \"20 N\"]";
  const std::size_t second = text.find("name = \"record2\"");
  ASSERT_NE(second, std::string::npos);
  EXPECT_EQ(text.substr(0, second).find("toe = "), std::string::npos);
  EXPECT_NE(text.substr(second).find(toe), std::string::npos);
  const Made turned = made({straight_rows("Opening [mm];Load [N]", 2, 0.5), straight_rows("Opening [mm];Load [N]", 2)});
  EXPECT_NE(turned.text.find(toe), std::string::npos);
  EXPECT_EQ(turned.text.substr(turned.text.find("name = \"record2\"")).find("toe = "), std::string::npos);
}

// A straight part gives its origin within noise: a fit estimates what is left, of the records that have a toe.
TEST(MachineRecords, WithAToeHaveTheirOffsetEstimated) {
  const Made result = made({straight_rows("Opening [mm];Load [N]", 2), straight_rows("Opening [mm];Load [N]", 2, 0.5)});
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  EXPECT_THAT(result.text.substr(result.text.find("name = \"record2\"")), HasSubstr("\noffset = \"0 mm\""));
  EXPECT_THAT(result.text, HasSubstr("\nkey = \"experiment.specimens[1].offset\"\nbounds = [\"-120 um\", \"120 um\"]"));
  EXPECT_THAT(result.text, Not(HasSubstr("specimens[0].offset")));
  EXPECT_EQ(result.warning, "");
}

/// The same rows with forces that alternate by +-`noise` [N] about the straight line, which meets zero force at 60 um.
std::string noisy_rows(double noise) {
  std::string text = "Opening [mm];Load [N]\n";
  for (int i = 0; i <= 40; ++i)
    text += fmt::format("{:.4f};{:.4f}\n", 0.1 * i + 0.06, i == 0 ? 0.0 : i + ((i / 2) % 2 == 0 ? noise : -noise));
  return text;
}

TEST(MachineRecords, KeepAnOriginThatNoiseMoves) {
  EXPECT_THAT(made({noisy_rows(0.0)}).text, HasSubstr("\ntoe = "));
  EXPECT_THAT(made({noisy_rows(1.5)}).text, Not(HasSubstr("toe = ")));
}

// Slack that noise hides makes the modulus too low: the fit has to look for it.
TEST(MachineRecords, EstimateTheOffsetOfAnOriginThatTheyKeep) {
  const Made kept = made({noisy_rows(-1.5)});
  EXPECT_THAT(kept.text, HasSubstr("\noffset = \"0 mm\""));
  EXPECT_THAT(kept.text, HasSubstr("\nkey = \"experiment.specimens[0].offset\"\nbounds = [\"-"));
  EXPECT_THAT(kept.outcome.out, HasSubstr("within noise: no toe, and the fit estimates the offset"));
  EXPECT_EQ(kept.warning, "");
  EXPECT_THAT(made({noisy_rows(-1.5)}, "lap_joint").text, Not(HasSubstr("offset")));
}

// Three rows are straight, and meet zero force at 0.15 mm, 12 standard errors off. One in a thousand is off by 637.
TEST(MachineRecords, OfFewRowsHaveWiderNoise) {
  const std::string rows = "0.1;0\n0.65;4.95\n1.15;10.05\n1.65;14.95\n2.15;20.05\n4.15;40\n";
  const Made few = made({"Opening [mm];Load [N]\n" + rows});
  EXPECT_THAT(few.text, Not(HasSubstr("toe = ")));
  EXPECT_THAT(few.text, HasSubstr("\nkey = \"experiment.specimens[0].offset\""));
}

TEST(MachineRecords, AreReducedByTheModulusThatIsGiven) {
  for (const std::string specimen : {"mixed_mode_bending", "compact_tension", "end_notched_flexure"}) {
    const std::string rows = straight_rows("Opening [mm];Load [N]", 2);
    std::vector<std::string> set{"young_modulus=20 GPa", "toughness=500 J/m^2", "strength=60 MPa"};
    if (specimen == "end_notched_flexure") set.push_back("shear_toughness=500 J/m^2");
    const Made given = made({rows}, specimen, set);
    ASSERT_EQ(given.outcome.status, 0) << given.outcome.err;
    const auto reduction_of = [](const std::string& text) {
      const std::size_t begin = text.find("[experiment.reduction]");
      return text.substr(begin, text.find("[[experiment", begin) - begin);
    };
    EXPECT_THAT(reduction_of(given.text), HasSubstr("\nyoung_modulus = \"20 GPa\"")) << specimen;
    EXPECT_EQ(given.warning, "") << specimen;
    if (specimen != "compact_tension") {  // data reduction finds another, which the comment has
      set.erase(set.begin());
      const Made guessed = made({rows}, specimen, set);
      const std::string said = "young_modulus: ", &out = guessed.outcome.out;
      const std::size_t at = out.find(said) + said.size();
      const std::string found = out.substr(at, out.find(" by data", at) - at);
      EXPECT_THAT(reduction_of(guessed.text), HasSubstr("\n# young_modulus = \"" + found + "\"")) << specimen;
    }
    EXPECT_THAT(made({}, specimen).text, HasSubstr("\n# # young_modulus = \"")) << specimen;
  }
}

/// A lap joint that stiffens from 20 to 60 kN/mm, and fails at 8 kN and 0.2 mm.
std::string stiffening_rows() {
  std::string text = "displacement [mm],load [N]\n";
  for (int i = 0; i <= 100; ++i) text += fmt::format("{},{}\n", 0.002 * i, 40.0 * i + 0.4 * i * i);
  return text;
}

TEST(MachineRecords, OfWhatStiffensKeepTheirOrigin) {
  const Made result = made({stiffening_rows()}, "lap_joint");
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  EXPECT_THAT(result.outcome.out, HasSubstr("the straight part meets zero force at "));
  EXPECT_THAT(result.text, Not(HasSubstr("\ntoe = ")));
  EXPECT_THAT(result.text, HasSubstr("\n# toe = ["));
  EXPECT_EQ(result.warning, "");
}

TEST(MachineRecords, AreFollowedUntilTheSpecimenHasFailed) {
  std::string text = stiffening_rows();
  for (int i = 1; i <= 50; ++i) text += fmt::format("{},20\n", 0.2 + 0.05 * i);
  const Made result = made({text}, "lap_joint");
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  EXPECT_THAT(result.text, HasSubstr("displacement = [\"0.202 mm\""));
  EXPECT_THAT(made({}, "lap_joint").text, HasSubstr("initial_increment = 0.00909090909\n"));  // 110 without a record
}

TEST(MachineRecords, OfFewRowsAreNamed) {
  const std::string few = "displacement [mm],load [N]\n0,0\n1,20\n2,100\n";
  for (const std::string specimen : {"lap_joint", "double_cantilever_beam"}) {
    const Outcome outcome = made({few}, specimen).outcome;
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("record1.csv: 1 rows lie between 10 and 50 %"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("data reduction")));
  }
}

// ASTM D6671 with E = 61 GPa, of which chi = 1.3178 by hand (E33 = 9 GPa, G13 = 5 GPa); 3 kJ/m^2, a from 30 to 49 mm.
TEST(MachineRecords, OfMixedModesTellToughnessAndModulus) {
  const double E = 61e9, b = 25e-3, h = 1.5e-3, chi = 1.3178, L = 50e-3, c = 42e-3,
               unit = 16 * L * L * b * h * h * h * E;
  const double opened = std::pow(3 * c - L, 2), bent = std::pow(c + L, 2);
  std::string text = "displacement [mm];load [N]\n";
  double end = 0.0;
  const auto add = [&](double a, double share) {
    const double A = a + chi * h, B = a + 0.42 * chi * h;
    const double P = share * std::sqrt(3000.0 * 2 * b * unit / (24 * A * A * opened + 18 * B * B * bent));
    const double d = P * (8 * A * A * A * opened + (6 * B * B * B + 4 * L * L * L) * bent) / unit;
    text += fmt::format("{:.6f};{:.4f}\n", 1e3 * d, P);
    if (a < 0.95 * L) end = 1e3 * d;
  };
  for (int i = 0; i < 40; ++i) add(30e-3, i / 40.0);
  for (int i = 0; i <= 95; ++i) add((30 + 0.2 * i) * 1e-3, 1.0);
  const Made result = made({text}, "mixed_mode_bending");
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  EXPECT_THAT(result.outcome.out, HasSubstr("toughness: 3 kJ/m^2 by data reduction"));
  EXPECT_THAT(result.outcome.out, HasSubstr("young_modulus: 61 GPa by data reduction"));
  EXPECT_THAT(result.text, HasSubstr(fmt::format("displacement = [\"free\", \"{:.3f}", 1.01 * end)));
  EXPECT_EQ(result.warning, "");
}

// Opened by 0.7 of (Gc W/E')^(1/2), where c/f of any crack is more: 80 steps, as without growth.
TEST(MachineRecords, ThatBreakOffEarlyLetNoCrackGrow) {
  std::string text = "displacement [mm],load [N]\n";
  for (int i = 0; i <= 40; ++i) text += fmt::format("{},{}\n", 0.0025 * i, 4.625 * i);
  const Made result = made({text}, "compact_tension", {"toughness=2 kJ/m^2", "strength=80 MPa"});
  ASSERT_EQ(result.outcome.status, 0) << result.outcome.err;
  EXPECT_THAT(result.text, HasSubstr("initial_increment = 0.0125\n"));
}

TEST(MachineRecords, NeedTheNameOfTheSpecimen) {
  const TemporaryCase directory(bar_case());
  directory.write("record.csv", straight_rows("Opening [mm];Load [N]", 2));
  const std::string place = (directory.path() / "new").string(), file = (directory.path() / "record.csv").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"init", place, "--data", file, "--specimen"},
                                                {"init", place, "--specimen", "--data", file},
                                                {"init", "--specimen", "--set", "width=20 mm"},
                                                {"init", "--specimen", dcb, "--data", file}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words.back();
    EXPECT_THAT(outcome.err, HasSubstr("--specimen"));
  }
}

}  // namespace
}  // namespace pfdm::this_file
