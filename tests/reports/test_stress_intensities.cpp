// Energy release rates and stress intensities.

#include "tests/reports/reported_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace pfdm::this_file {
namespace {

// The last row of a table, by its columns.
std::map<std::string, double> last_row(const std::string& table) {
  std::istringstream lines(table);
  std::string head, line, last;
  std::getline(lines, head);
  while (std::getline(lines, line)) last = line;
  std::istringstream names(head), values(last);
  std::map<std::string, double> row;
  for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
    row[name] = std::stod(value);
  return row;
}

// Two arms of h = 2 mm, a = 20 mm long, each moved by u: G = 3/4 E' h^3 u^2/(a + 0.673 h)^4 (Foote, Buchwald, Int. J.
// Fract. 29 (1985) 125), of which half the body has half, and K1 = (E' G)^(1/2). About the given tip the interaction
// integral is 2.5 % above that with 16 cells an arm.
// G of 8, 16 and 32 cells an arm: 65.5, 66.0, 66.5 J/m^2; the inputs have 16.
TEST(ReportedCracks, HaveTheStressIntensityOfTheirEnergyReleaseRate) {
  for (const auto& [folder, G] : {std::pair{"whole", 66.7}, std::pair{"half", 33.35}}) {
    SCOPED_TRACE(folder);
    const ReportedCase arms(std::string("30_J_and_K/") + folder);
    const Outcome run = arms.run("run");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out + run.err, testing::Not(testing::HasSubstr("no stress intensities")));
    auto row = last_row(content_of(arms.results() / "energy_release_rate.csv"));
    EXPECT_NEAR(row["tip_G_J_per_m2"], G, 0.014 * G);
    EXPECT_NEAR(row["tip_K1_Pa_sqrt_m"], 3.923e6, 0.007 * 3.923e6);
    EXPECT_NEAR(row["tip_K2_Pa_sqrt_m"], 0.0, 1e3);
    EXPECT_NEAR(row["tip_phase_angle_degree"], 0.0, 0.01);
  }
}

// Ahead of the tip the plane of half a body has to be one of symmetry.
TEST(ReportedCracks, SayWhyThereIsNoStressIntensity) {
  const ReportedCase half("30_J_and_K/half");
  std::string text = content_of(half.path() / "case.toml");
  const std::string symmetry = "type = \"symmetry\"";
  text.replace(text.find(symmetry), symmetry.size(), "displacement = [\"0 mm\", \"0 mm\", \"free\"]");
  std::ofstream(half.path() / "case.toml") << text;
  const Outcome run = half.run("run");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out + run.err, testing::HasSubstr("no stress intensities: the ring lies on one side of the crack, "
                                                    "whose plane is not one of symmetry ahead of the tip"));
}

}  // namespace
}  // namespace pfdm::this_file
